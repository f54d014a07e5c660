#pragma once

#include <cstdint>
#include <unordered_map>

#include "formwork/segment/field_problem.hpp"

namespace formwork {

/// Descent over the periods of (12). Adding a quarter turn to the period of one edge moves a quarter of
/// index between its two end nodes: it moves a singularity, makes a pair or cancels one. For a relaxed state,
/// the edges of a chain changed by s_e = +-1, c = pi/2 and b = sum s_e (e_i - e_j), the energy after
/// relaxing again is, as long as no data changes its branch (which can only lower it),
///
///   E' = E + 2 c sum s_e r_e + c² (n - bᵀ A⁻¹ b)
///
/// A does not depend on the periods: a trial costs one partial forward substitution. Where the data are weak
/// the last factor is the resistance between the chain's ends in the network of mesh edges: about 1/3 for
/// neighbours, growing like a logarithm. So charges attract and repel as in electrostatics, and are moved
/// until none wants to move.
class PeriodSearch {
public:
    /// @param price   what one quarter of singular index costs beside its energy, rad²: pairs that the data
    ///                hardly need are cancelled
    PeriodSearch(const Surface& s, const Topology& t, const AngleSystem& angles, double price);

    /// Lowers cost() until no trial does. @return rounds
    int descend(FieldState& state);

    /// (12) plus the price of the singularities.
    double cost(const FieldState& state) const;

    /// Four times the index per node; 0 on the boundary.
    std::vector<int> indices(const FieldState& state) const;

private:
    struct Step {          // one dual edge and the sign of its change
        int dual;
        int sign;
    };
    struct Trial {
        double gain = 0;   // change of cost, < 0 is better
        std::vector<Step> steps;
    };

    double change(const FieldState& state, const std::vector<Step>& steps) const;
    double chain_norm(const std::vector<Step>& steps) const;
    double single_edge_rise(int dual);
    int count_change(const std::vector<int>& index4, const std::vector<Step>& steps) const;
    void add_edge_trials(const FieldState& state, const std::vector<int>& index4, std::vector<Trial>& list);
    Trial best_path_trial(const FieldState& state, const std::vector<int>& index4, int node) const;
    std::vector<Trial> without_conflicts(std::vector<Trial> list) const;
    bool accept(FieldState& state, const std::vector<Trial>& list) const;
    std::vector<double> signature(const FieldState& state, int node) const;

    const Surface& s_;
    const Topology& t_;
    const AngleSystem& angles_;
    const FieldProblem& problem_;
    double price_;
    std::vector<std::vector<FanStep>> fans_;   // `edge` is the dual edge here
    std::vector<int> base4_;                   // per node: index4 if all periods were 0
    mutable std::unordered_map<std::uint64_t, double> chain_norm_;   // bᵀA⁻¹b of the chains asked for so far: A never changes
    std::vector<double> rise_;                 // c² (1 - bᵀA⁻¹b) per dual edge; < 0: not computed yet
};

}  // namespace formwork
