#include "formwork/mesher/mesh_recipe.hpp"

#include "arcsim/base/json_reader.hpp"
#include "arcsim/base/params_schema.hpp"
#include "formwork/mesher/mesh_file.hpp"
#include "formwork/mesher/mesh_kinds.hpp"

namespace formwork {

namespace {

template <class Size, auto make>
std::string make_obj(const arcsim::JsonDocument& keys, const std::string& comment) {
    Size size;
    arcsim::Warnings warnings;
    arcsim::read_params(keys, size, warnings);
    return format_plain_obj(make(size), comment);
}

template <class Size, auto make>
MeshRecipe recipe(const char* name, const char* what) {
    return {name, what, &arcsim::schema_of<Size>, &make_obj<Size, make>};
}

}  // namespace

const std::vector<MeshRecipe>& mesh_recipes() {
    static const std::vector<MeshRecipe> recipes{
        recipe<ColumnSize, make_column>("column", "tapered, twisted column bag of superellipse section, closed bottom, open rim"),
        recipe<DiskSize, make_disk>("disk", "flat disk in the plane z = 0"),
        recipe<PillowSize, make_pillow>("pillow", "two flat panels sewn at the edge, with a spout; vt hold the flat rest shape"),
        recipe<SockSize, make_sock>("sock", "cylinder with a flat bottom and an open rim"),
        recipe<SphereSize, make_sphere>("sphere", "sphere, closed or with a hole at the top"),
        recipe<StripSize, make_strip>("strip", "flat rectangle in the plane z = 0"),
        recipe<VaseSize, make_vase>("vase", "vase with belly and neck, closed foot, open lip")};
    return recipes;
}

}  // namespace formwork
