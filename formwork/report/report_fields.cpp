#include "formwork/report/report_fields.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace formwork {
namespace {

void expect(bool fits, const char* what) {
    if (!fits)
        throw std::invalid_argument(std::string("report: ") + what + " does not fit its mesh");
}

/// Positions on the input mesh carried to the nodes of the cut mesh.
std::vector<Vector3d> carry(const ReportInput& in, const std::vector<Vector3d>& x) {
    std::vector<Vector3d> out;
    for (const SurfacePoint& p : in.segmentation->source) {
        const arcsim::Triangle& t = in.rest.faces.at(p.face);
        out.push_back(p.barycentric[0] * x[t[0]] + p.barycentric[1] * x[t[1]] +
                      p.barycentric[2] * x[t[2]]);
    }
    return out;
}

class FieldList {
public:
    FieldList(std::vector<ReportField>& out, std::string of, const StrainField& strain,
              const std::vector<int>* source_face)
        : out_(out), of_(std::move(of)), strain_(strain), source_face_(source_face) {}

    template <class Member>
    ReportField& add(const char* key, const char* title, const char* unit, bool diverging,
                     Member member) {
        ReportField f;
        f.key = of_ + "-" + key, f.of = of_;
        const size_t n = source_face_ ? source_face_->size() : strain_.size();
        for (size_t i = 0; i < n; ++i)
            f.values.push_back(member(strain_[source_face_ ? (*source_face_)[i] : i]));
        f.scale = diverging ? diverging_scale(f.values, title, unit)
                            : sequential_scale(f.values, title, unit);
        out_.push_back(std::move(f));
        return out_.back();
    }
    void add_common() {
        add("lambda1", "stretch \u03bb\u2081", "-", false,
            [](const FaceStrain& s) { return s.lambda1; });
        add("lambda2", "stretch \u03bb\u2082", "-", false,
            [](const FaceStrain& s) { return s.lambda2; });
        add("tension", "largest tension", "N/m", false,
            [](const FaceStrain& s) { return s.tension1; });
        ReportField& state = add("state", "state", "", false,
                                 [](const FaceStrain& s) { return static_cast<double>(s.state); });
        state.classes = {"taut", "wrinkled", "slack"};
    }
    void add_weave() {
        add("shear", "shear |\u03b5_uv|", "-", false,
            [](const FaceStrain& s) { return std::abs(s.eps_uv); });
        // Corollary 1: deformed warp and weft meet at theta with cos theta = 2 eps_uv / (lambda_u
        // lambda_v).
        add("angle", "angle of warp and weft off 90\u00b0", "\u00b0", true,
            [](const FaceStrain& s) {
                const double lengths = std::sqrt(std::max(1 + 2 * s.eps_uu, 1e-12) *
                                                 std::max(1 + 2 * s.eps_vv, 1e-12));
                return -std::asin(std::clamp(2 * s.eps_uv / lengths, -1.0, 1.0)) * 180 / M_PI;
            });
        add("warp", "warp strain \u03b5_uu", "-", true,
            [](const FaceStrain& s) { return s.eps_uu; });
        add("weft", "weft strain \u03b5_vv", "-", true,
            [](const FaceStrain& s) { return s.eps_vv; });
    }

private:
    std::vector<ReportField>& out_;
    std::string of_;
    const StrainField& strain_;
    const std::vector<int>* source_face_;
};

}  // namespace

ReportMesh report_mesh(const ReportInput& in) {
    ReportMesh m;
    m.rest = in.segmentation ? in.segmentation->mesh : in.rest;
    expect(!in.segmentation || in.segmentation->source.size() == m.rest.x.size(),
           "the source of the cut mesh");
    // The cut mesh may lie on the inflated shape: the rest positions come from the input mesh in
    // either case.
    m.shapes.push_back({"rest", "Rest", in.segmentation ? carry(in, in.rest.x) : in.rest.x});
    if (!in.inflated.empty()) {
        expect(in.inflated.size() == in.rest.x.size(), "the inflated shape");
        const bool cut = in.segmentation.has_value();
        expect(!cut || in.segmentation->source.size() == m.rest.x.size(),
               "the source of the cut mesh");
        m.shapes.push_back({"inflated", "Inflated", cut ? carry(in, in.inflated) : in.inflated});
    }
    if (!in.sewn.empty()) {
        expect(in.sewn.size() == m.rest.x.size(), "the sewn shape");
        m.shapes.push_back({"sewn", "Sewn", in.sewn});
    }
    return m;
}

std::vector<ReportField> report_fields(const ReportInput& in) {
    std::vector<ReportField> out;
    const std::vector<int>* source = in.segmentation ? &in.segmentation->source_face : nullptr;
    if (!in.inflated_strain.empty()) {
        expect(in.inflated_strain.size() == in.rest.faces.size(), "the inflated strain");
        expect(!source || source->size() == in.segmentation->mesh.faces.size(),
               "the source of the cut mesh's faces");
        FieldList(out, "inflated", in.inflated_strain, source).add_common();
    }
    if (!in.sewn_strain.empty()) {
        expect(in.segmentation && in.sewn_strain.size() == in.segmentation->mesh.faces.size(),
               "the sewn strain");
        FieldList list(out, "sewn", in.sewn_strain, nullptr);
        list.add_weave();
        list.add_common();
    }
    if (!in.deviation.empty()) {
        expect(in.segmentation && in.deviation.size() == in.segmentation->mesh.x.size(),
               "the deviation");
        ReportField f;
        f.key = "sewn-deviation", f.of = "sewn", f.per_node = true;
        for (const double d : in.deviation) f.values.push_back(1000 * d);
        const std::string from = in.deviation_from.empty() ? "" : " from " + in.deviation_from;
        f.scale = diverging_scale(f.values, "deviation" + from, "mm");
        out.push_back(std::move(f));
    }
    return out;
}

}  // namespace formwork
