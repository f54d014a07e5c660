#pragma once

#include <string>
#include <vector>

#include "formwork/segment/cut_mesh.hpp"
#include "formwork/segment/panel_split.hpp"

namespace formwork {

/// What a finished layout must meet, besides the rules of a single cut.
struct LayoutLimits {
    int max_panels = 24;
};

/// What is known about one panel.
struct PanelQuality {
    bool is_disk = false;
    double p95 = 0;       // stretch of the flat pattern that 95 % of the area stays below
    int corners = 0;
    double width = 0;     // m
};

/// Panels of a surface that is being cut. Few panels, not a quad layout: curves are added where they lower the
/// stretch most per metre until every panel is a disk that flattens within the bound; then every seam that
/// is not needed goes again.
class Layout {
public:
    Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
           const SplitRules& rules, const LayoutLimits& limits);

    /// Marks the curve (of the whole mesh's numbering) as a seam before the search: strokes, creases, mirror planes.
    void add_given(const Curve& curve);
    /// Open, refine, prune.
    void search();

    const CutMesh& cut() const { return cut_; }
    CutMesh& cut() { return cut_; }
    SurfaceField field_on(const std::vector<int>& faces) const;
    int n_panels() const;
    /// Bounds that are not met, one line each; panels numbered as label_panels does.
    std::vector<std::string> violations();

private:
    struct Panel {
        bool alive = true, assessed = false, stuck = false;
        PanelQuality quality;
    };

    void relabel(int panel);
    std::vector<int> faces_of(int panel) const;
    PanelQuality assess(const PanelPatch& patch) const;
    const PanelQuality& quality(int panel);
    bool split(int panel, bool anyhow);
    int worst_panel();
    void refine();
    bool prune();
    bool try_merge(int a, int b, const std::vector<std::pair<int, int>>& edges);

    const Surface& input_;
    SplitRules rules_;
    LayoutLimits limits_;
    CutMesh cut_;
    std::vector<Vector3d> arm_, principal_;     // per input face: directions in space
    const std::vector<DirectionData>& data_;
    std::vector<int> panel_;                    // per face of the cut mesh
    std::vector<Panel> panels_;
};

}  // namespace formwork
