#pragma once

#include <map>
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
    double area = 0;      // m²
    double estimate = 0;  // of the stretch, before flattening
    bool is_flattened = false;   // p95 is measured, not derived from the estimate
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

    /// Goes on with a mesh that is cut already.
    Layout(const Surface& input, const std::vector<double>& theta, const std::vector<DirectionData>& data,
           const SplitRules& rules, const LayoutLimits& limits, CutMesh cut);

    /// Makes the curve (of the cut mesh's numbering) a seam before the search; one that is `given` stays.
    /// @returns false, and nothing is marked, when the curve crosses itself
    [[nodiscard]] bool add_curve(const Curve& curve, bool given);
    /// Open, refine, prune.
    void search();
    /// Leaves out of the search every panel that lies on the far side of a plane.
    void keep_one_side(const Vector3d& point, const Vector3d& normal);
    /// Per face: 1 where the search went on.
    std::vector<char> kept_faces() const;
    /// Removes seams between panels and their mirror images where that keeps the bounds.
    void merge_images(const std::vector<int>& face_image);

    const CutMesh& cut() const { return cut_; }
    CutMesh& cut() { return cut_; }
    /// The field on the faces of a mesh that lies on the input.
    SurfaceField field_on(const Surface& mesh, const std::vector<int>& source_face) const;
    int n_panels() const;
    /// Bounds that are not met, one line each; panels numbered as label_panels does.
    std::vector<std::string> violations();

private:
    struct Panel {
        bool alive = true, assessed = false, stuck = false, frozen = false;
        PanelQuality quality;
    };

    void relabel(int panel);
    std::vector<int> faces_of(int panel) const;
    SurfaceField field_on(const PanelPatch& patch) const;
    PanelQuality look_at(const PanelPatch& patch, double calibration) const;
    void flatten(const PanelPatch& patch, PanelQuality& q) const;
    const PanelQuality& quality(int panel);
    double excess(const PanelQuality& q) const;
    bool is_valid(const PanelQuality& q) const;
    double calibration(const PanelQuality& q) const;

    struct Trial {
        Curve curve;   // numbers of the cut mesh
        double length = 0;
        std::vector<PanelPatch> pieces;
        std::vector<PanelQuality> qualities;   // from estimates
        double excess = 0;         // of the pieces together
        bool is_allowed = false;   // disks with few corners
    };
    std::vector<Trial> try_splits(const PanelPatch& patch, const PanelQuality& q, int count) const;
    void flatten(Trial& trial) const;
    bool split(int panel, bool anyhow);
    int worst_panel();
    void refine();

    struct Border {
        double length = 0;
        bool is_given = false;
        std::vector<std::pair<int, int>> edges;
    };
    std::map<std::pair<int, int>, Border> borders() const;
    PanelPatch joined(int a, int b, const Border& border, std::vector<int>& faces);
    bool try_merge(int a, int b, const Border& border);
    bool prune();
    bool resplit(int a, int b, const Border& border);
    bool improve();

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
