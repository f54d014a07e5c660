#pragma once

#include <string>
#include <vector>

#include "formwork/panels/flat_panel.hpp"
#include "formwork/report/render_surface.hpp"
#include "formwork/report/seam_edge_force.hpp"
#include "formwork/segment/segmentation.hpp"
#include "formwork/strain/strain_field.hpp"

namespace formwork {

/// The pictures of each stage, one function each; all take `up` and return an image for write_png.
/// `shown` is the shape that is drawn (rest, inflated or sewn); fields have one entry per face of
/// it.

Image picture_stretch(const Surface& shown, const StrainField& strain, const Vector3d& up,
                      const std::string& title);
Image picture_states(const Surface& shown, const StrainField& strain, const Vector3d& up,
                     const std::string& title);
Image picture_tension(const Surface& shown, const StrainField& strain, const Vector3d& up,
                      const std::string& title);
/// |eps_uv| in the weave frame.
Image picture_shear(const Surface& shown, const StrainField& strain, const Vector3d& up,
                    const std::string& title);

/// Signed distance from a surface, per node, m; drawn in mm. Positive: outside it.
Image picture_deviation(const Surface& shown, const std::vector<double>& distance,
                        const Vector3d& up, const std::string& title);

/// Seams in the colour of their threads' forces.
Image picture_seam_forces(const Surface& shown, const std::vector<SeamEdgeForce>& seams,
                          const Vector3d& up, const std::string& title);

/// Crosses along the directions, coloured by their weight where data is given. @param theta  per
/// face, from edge v0->v1
Image picture_cross_field(const Surface& shown, const std::vector<double>& theta,
                          const std::vector<DirectionData>& data,
                          const std::vector<Singularity>& singularities, const Vector3d& up,
                          const std::string& title);

/// Chains of points on the surface: all candidate curves, faint, and the chosen ones, bold.
Image picture_curves(const Surface& shown, const std::vector<std::vector<Vector3d>>& candidates,
                     const std::vector<std::vector<Vector3d>>& chosen,
                     const std::vector<Singularity>& singularities, const Vector3d& up,
                     const std::string& title);

/// Panels in their colours with their names and seams. `shown` has the nodes and faces of
/// segmentation.mesh.
Image picture_panels(const Segmentation& segmentation, const Surface& shown, const Vector3d& up,
                     const std::string& title);

/// The flat pieces at one common scale, warp upwards, with name, grain arrow and a scale bar.
Image picture_flat_panels(const Segmentation& segmentation, const std::vector<FlatPanel>& panels,
                          const std::string& title);

/// One colour per panel, different across seams; the same in every picture and in the report.
std::vector<Rgb> panel_colours(const Segmentation& segmentation);

}  // namespace formwork
