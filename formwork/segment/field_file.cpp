#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "arcsim/base/error.hpp"
#include "formwork/segment/anisotropy_weight.hpp"
#include "formwork/segment/direction_data.hpp"

namespace formwork {
namespace {

constexpr std::string_view blanks = " \t\r";

/// Up to five numbers of a line; throws naming file and line when a word is not a finite number.
std::vector<double> numbers_of(std::string_view line, const std::string& where) {
    std::vector<double> numbers;
    while (true) {
        const auto begin = line.find_first_not_of(blanks);
        if (begin == std::string_view::npos) return numbers;
        line.remove_prefix(begin);
        const std::string_view word = line.substr(0, line.find_first_of(blanks));
        line.remove_prefix(word.size());
        double value = 0;
        const char* first = word.data() + (word.front() == '+');
        const auto [end, code] = std::from_chars(first, word.data() + word.size(), value);
        if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
            throw arcsim::InputError(where + "expected a finite number, got \"" + std::string(word) +
                                     "\". Each line is: theta s1 s2 [weight].");
        numbers.push_back(value);
    }
}

}  // namespace

std::vector<DirectionData> read_field_file(const std::string& path, const Topology& t, const DirectionParams& params) {
    std::ifstream in(path);
    if (!in) throw arcsim::InputError(path + ": cannot be read. Give the file of one direction per face.");
    const std::size_t n = t.face_edges.size();
    std::vector<DirectionData> data;
    std::vector<double> anisotropy;
    std::size_t columns = 0;
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        const std::string where = path + ":" + std::to_string(number) + ": ";
        const auto text = line.find_first_not_of(blanks);
        if (text == std::string::npos || line[text] == '#') continue;
        const std::vector<double> x = numbers_of(line, where);
        if (x.size() != 3 && x.size() != 4)
            throw arcsim::InputError(where + "expected 3 or 4 numbers, got " + std::to_string(x.size()) +
                                     ". Each line is: theta s1 s2 [weight].");
        if (columns != 0 && columns != x.size())
            throw arcsim::InputError(where + "has " + std::to_string(x.size()) + " numbers, the lines before have " +
                                     std::to_string(columns) + ". Give the weight on every line or on none.");
        columns = x.size();
        if (x[1] <= 0 || x[2] <= 0)
            throw arcsim::InputError(where + "a stretch is not above 0. Stretches are lengths relative to rest: 1 is unstretched.");
        if (columns == 4 && x[3] < 0) throw arcsim::InputError(where + "the weight is below 0. Use 0 for faces without a preference.");
        data.push_back({x[0], x[1], x[2], columns == 4 ? x[3] : 0});
        anisotropy.push_back(std::abs(x[1] - x[2]));
        if (data.size() > n) break;
    }
    if (data.size() != n)
        throw arcsim::InputError(path + ": has " + (data.size() > n ? "more than " + std::to_string(n) : std::to_string(data.size())) +
                                 " directions, the mesh has " + std::to_string(n) + " faces. Give one line per face, in the mesh's order.");
    if (columns == 3) {
        const std::vector<double> weight = anisotropy_weights(t, anisotropy, params.anisotropy);
        for (std::size_t f = 0; f < n; ++f) data[f].weight = weight[f];
    }
    return data;
}

}  // namespace formwork
