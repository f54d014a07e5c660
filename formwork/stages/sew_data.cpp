#include "formwork/stages/sew_data.hpp"

#include "arcsim/mesh/obj_io.hpp"
#include "formwork/stages/summary.hpp"

namespace formwork {
namespace {

std::optional<double> inflated_figure(const std::filesystem::path& dir, const char* key) {
    const arcsim::JsonValue summary = read_summary(dir);
    const arcsim::JsonValue* inflate = summary.find("inflate");
    const arcsim::JsonValue* figure = inflate ? inflate->find(key) : nullptr;
    if (!figure || figure->kind != arcsim::JsonKind::number) return std::nullopt;
    return figure->number;
}

}  // namespace

SewInput SewData::input(const FormworkScene& scene, const Segmentation& cut, const std::vector<FlatPanel>& panels) const {
    return {cut,  panels, mesh.surface.faces, inflated, held, scene.formwork.up, scene.plaster(), inflated_level, inflated_volume, {}};
}

SewData read_sew_data(const StageContext& context) {
    SewData data;
    data.mesh = load_bag_mesh(context.scene);
    data.held = held_dofs(context.scene, data.mesh);
    const std::filesystem::path file = context.dir / "inflate" / "inflated.obj";
    data.inflated = arcsim::read_obj(file).x;
    if (data.inflated.size() != data.mesh.surface.x.size())
        throw arcsim::InputError(file.string() + ": belongs to another mesh than the scene's. Run the stage inflate again.");
    data.inflated_level = inflated_figure(context.dir, "fill_level_m");
    data.inflated_volume = inflated_figure(context.dir, "volume_m3");
    return data;
}

}  // namespace formwork
