#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formwork/segment/cut_mesh.hpp"
#include "formwork/segment/panel_quality.hpp"

namespace formwork {

/// What a finished layout must meet, besides the rules of a single cut.
struct LayoutLimits {
    int max_panels = 24;
    std::function<void(std::string_view)> on_step;   // told, a few times a second, what stands; may throw to end the search
};

/// Which panels are laid out anew.
enum class Rework { out_of_bounds, all };

/// Panels of a surface that is being cut. Few panels, not a quad layout: curves are added where they lower the
/// stretch most per metre until every panel is a disk that flattens within the bound; then every seam that
/// is not needed goes again.
class Layout {
public:
    Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
           const SplitRules& rules, const LayoutLimits& limits);

    /// Goes on with a mesh that is cut already.
    Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
           const SplitRules& rules, const LayoutLimits& limits, CutMesh cut);

    /// Makes the curve (of the cut mesh's numbering) a seam before the search; one that is `given` stays.
    /// @returns false, and nothing is marked, when the curve crosses itself
    [[nodiscard]] bool add_curve(const Curve& curve, bool given);
    /// Opens and refines, prunes, improves.
    void search();
    /// Splits what is no disk or does not lie flat within the bound. @returns whether a seam was added
    bool refine() { return refine(limits_.max_panels); }
    /// Lays out anew, with some of its neighbours, every panel that is out of bounds; with `Rework::all` those that are hard
    /// to sew, too. @param share  of all work that may be spent when this ends  @returns whether that changed anything
    bool rework(Rework what, double share = 1);
    /// Gives a dart to every panel that stretches too much, where that takes at least half of the excess away.
    /// @returns whether there was one
    bool add_darts();
    /// Leaves out of the search every panel that lies on the far side of a plane.
    void keep_one_side(const Vector3d& point, const Vector3d& normal);
    /// Per face: 1 where the search went on.
    std::vector<char> kept_faces() const;
    /// Removes seams between panels and their mirror images where that keeps the bounds.
    void merge_images(const std::vector<int>& face_image);

    /// Every curve that was compared when search() split a panel.
    const std::vector<CandidateCurve>& candidates() const { return candidates_; }
    const CutMesh& cut() const { return cut_; }
    CutMesh& cut() { return cut_; }
    /// The field on the faces of a mesh that lies on the input.
    SurfaceField field_on(const Surface& mesh, const std::vector<int>& source_face) const;
    int n_panels() const;
    /// What the layout costs, in panels: its panels, bounds that are not kept, and one for every sqrt(area) of seam.
    double cost();
    bool keeps_bounds();
    /// Bounds that are not met, one line each; panels numbered as label_panels does.
    std::vector<std::string> violations();

private:
    struct Panel {
        bool alive = true, stuck = false, frozen = false;
        bool parked = false;     // left alone while a group of others is laid out anew
        bool looked_at = false;  // all is known but the flat pattern
        bool assessed = false;   // and that
        PanelQuality quality;
    };

    void relabel(int panel);
    std::vector<int> faces_of(int panel) const;
    SurfaceField field_on(const PanelPatch& patch) const;
    const PanelQuality& look(int panel);
    const PanelQuality& quality(int panel);
    void tell() const;
    double excess(const PanelQuality& q) const { return excess_of(q, rules_); }

    struct Trial {
        Curve curve;   // numbers of the cut mesh
        double length = 0;
        std::vector<PanelPatch> pieces;
        std::vector<PanelQuality> qualities;   // from estimates
        double excess = 0;         // of the pieces together
        bool is_allowed = false;   // disks with few corners
    };
    static Curve on_cut(const PanelPatch& patch, Curve curve);
    std::vector<Trial> try_splits(const PanelPatch& patch, const PanelQuality& q, int count,
                                  std::vector<CandidateCurve>* all = nullptr) const;
    void measure_flat(Trial& trial) const;
    bool refine(int most_panels);
    bool split(int panel, bool anyhow);
    bool add_dart(int panel);
    int worst_panel();

    struct Border {
        double length = 0;
        bool is_given = false;
        std::vector<std::pair<int, int>> edges;
    };
    using Borders = std::map<std::pair<int, int>, Border>;
    Borders borders() const;
    PanelPatch joined(int a, int b, const Border& border, std::vector<int>& faces);
    bool try_merge(int a, int b, const Border& border);
    bool prune();
    bool resplit(int a, int b, const Border& border);
    bool improve();

    struct State {   // to go back to
        CutMesh cut;
        std::vector<int> panel;
        std::vector<Panel> panels;
    };
    void restore(const State& s);
    std::vector<int> hard_panels(Rework what);
    enum class GroupSize { alone, pair, triple, ring };
    std::vector<std::vector<int>> groups_around(int seed, GroupSize size, const Borders& all);
    GroupTrace trace_of(const std::vector<int>& group);
    double group_floor(int most_panels);
    bool rework(const std::vector<int>& group);

    const Surface* input_;
    SplitRules rules_;
    LayoutLimits limits_;
    CutMesh cut_;
    std::vector<Vector3d> arm_, principal_;     // per input face: directions in space
    const std::vector<DirectionData>* data_;
    std::vector<int> panel_;                    // per face of the cut mesh
    std::vector<Panel> panels_;
    std::vector<CandidateCurve> candidates_;
    bool keeps_candidates_ = false;
};

}  // namespace formwork
