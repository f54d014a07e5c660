#include "formwork/stages/stage.hpp"

namespace formwork {

const std::vector<Stage>& stages() {
    static const std::vector<Stage> table{
        {"inflate", {}, {"inflate/inflated.obj", "inflate/rest.obj", "inflate/strain.csv", "inflate/tension.csv"}, run_inflate},
        {"segment", {"inflate/rest.obj", "inflate/strain.csv"},
         {"segment/segments.obj", "segment/labels.csv", "segment/field.csv", "segment/singularities.csv", "segment/seams.csv",
          "segment/source.csv", "segment/directions.csv"}, run_segment},
        {"panels", {"segment/segments.obj", "segment/labels.csv", "segment/seams.csv", "segment/directions.csv"},
         {"panels/sewn_rest.obj", "panels/panels.csv", "panels/panels.svg"}, run_panels},
        {"sew", {"panels/sewn_rest.obj", "segment/segments.obj", "segment/source.csv", "inflate/inflated.obj"},
         {"sew/sewn.obj", "sew/strain.csv", "sew/weave.csv", "sew/panels.csv", "sew/seams.csv", "sew/seam_edges.csv", "sew/deviation.csv"}, run_sew},
        {"report", {}, {"report.html"}, run_report}};
    return table;
}

}  // namespace formwork
