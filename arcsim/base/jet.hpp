#pragma once

#include <array>
#include <cmath>

namespace arcsim {

/// A number with its derivatives by N variables (forward differentiation): second derivatives of an element
/// come from its gradient kernel, run once on jets. For exact tangents and tests; not for inner loops.
template <int N>
struct Jet {
    double value = 0;
    std::array<double, N> d{};

    Jet() = default;
    Jet(double v) : value(v) {}
    static Jet variable(double v, int i) {
        Jet j(v);
        j.d[i] = 1;
        return j;
    }
    Jet scaled(double new_value, double factor) const {   // f(this) with f' = factor
        Jet r(new_value);
        for (int i = 0; i < N; ++i) r.d[i] = factor * d[i];
        return r;
    }
    friend Jet operator+(Jet a, const Jet& b) {
        a.value += b.value;
        for (int i = 0; i < N; ++i) a.d[i] += b.d[i];
        return a;
    }
    friend Jet operator-(Jet a, const Jet& b) {
        a.value -= b.value;
        for (int i = 0; i < N; ++i) a.d[i] -= b.d[i];
        return a;
    }
    Jet operator-() const { return scaled(-value, -1); }
    friend Jet operator*(const Jet& a, const Jet& b) {
        Jet r(a.value * b.value);
        for (int i = 0; i < N; ++i) r.d[i] = a.d[i] * b.value + a.value * b.d[i];
        return r;
    }
    friend Jet operator/(const Jet& a, const Jet& b) {
        Jet r(a.value / b.value);
        for (int i = 0; i < N; ++i) r.d[i] = (a.d[i] - r.value * b.d[i]) / b.value;
        return r;
    }
};

template <int N>
Jet<N> square_root(const Jet<N>& a) {
    const double root = std::sqrt(a.value);
    return a.scaled(root, 0.5 / root);
}
template <int N>
Jet<N> larger(const Jet<N>& a, const Jet<N>& b) {
    return a.value > b.value ? a : b;
}

}  // namespace arcsim
