#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace formwork {

/// Edge, by its two nodes, -> number. One block of memory with open addressing [Knuth 1998, 6.4, linear probing]: cut meshes
/// are built and copied for every trial, and a node-based map would spend that time in the allocator.
class EdgeMap {
public:
    void reserve(std::size_t n) {
        std::size_t size = 16;
        while (size < 2 * n) size *= 2;
        if (size > slots_.size()) rehash(size);
    }

    /// The edge's number; nullptr: not in the map.
    const int* find(int a, int b) const {
        if (slots_.empty()) return nullptr;
        const Slot& s = slots_[place_of(key(a, b))];
        return s.key == none ? nullptr : &s.value;
    }
    bool contains(int a, int b) const { return find(a, b) != nullptr; }

    void set(int a, int b, int value) {
        reserve(count_ + 1);
        Slot& s = slots_[place_of(key(a, b))];
        if (s.key == none) ++count_;
        s = {key(a, b), value};
    }

    void erase(int a, int b) {
        if (slots_.empty()) return;
        std::size_t hole = place_of(key(a, b));
        if (slots_[hole].key == none) return;
        --count_;
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t i = (hole + 1) & mask; slots_[i].key != none; i = (i + 1) & mask) {   // who would no longer be found moves up
            if (((i - home(slots_[i].key)) & mask) < ((i - hole) & mask)) continue;
            slots_[hole] = slots_[i];
            hole = i;
        }
        slots_[hole].key = none;
    }

private:
    static constexpr std::uint64_t none = ~std::uint64_t{0};
    struct Slot {
        std::uint64_t key = none;
        int value = 0;
    };

    static std::uint64_t key(int a, int b) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 | static_cast<std::uint32_t>(b);
    }
    std::size_t home(std::uint64_t k) const { return (k * 0x9E3779B97F4A7C15u >> 20) & (slots_.size() - 1); }   // Fibonacci hashing
    std::size_t place_of(std::uint64_t k) const {
        std::size_t i = home(k);
        while (slots_[i].key != k && slots_[i].key != none) i = (i + 1) & (slots_.size() - 1);
        return i;
    }
    void rehash(std::size_t size) {
        std::vector<Slot> old(size);
        old.swap(slots_);
        for (const Slot& s : old)
            if (s.key != none) slots_[place_of(s.key)] = s;
    }

    std::vector<Slot> slots_;   // a power of two, at most half full
    std::size_t count_ = 0;
};

}  // namespace formwork
