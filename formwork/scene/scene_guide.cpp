#include "formwork/scene/scene_guide.hpp"

#include "arcsim/base/params_schema.hpp"

namespace formwork {

using arcsim::JsonValue;

namespace {

/// Comment lines for every key of an object's schema, deeper ones indented.
void explain(const JsonValue& schema, const std::string& indent, std::string& out) {
    const JsonValue* properties = schema.find("properties");
    if (!properties) return;
    for (const auto& [key, value] : properties->members) {
        out += "//   " + indent + "\"" + key + "\"";
        if (const JsonValue* d = value.find("default")) out += ": " + arcsim::to_text_one_line(*d);
        if (const JsonValue* doc = value.find("description")) out += "   " + doc->string;
        out += "\n";
        explain(value, indent + "    ", out);
        if (const JsonValue* items = value.find("items")) explain(*items, indent + "    ", out);
    }
}

}  // namespace

std::string starter_scene_text() {
    std::string text =
        "// A bag of fabric filled with plaster. Lengths in m, masses in kg, fabric stiffness in N/m; comments are allowed.\n"
        "//   formwork check scene.json      looks at scene and mesh\n"
        "//   formwork run scene.json        fills, cuts, flattens, sews, fills again, reports\n"
        "{\n"
        "  \"$schema\": \"scene.schema.json\",\n"
        "  \"cloths\": [{\"mesh\": \"bag.obj\"}],           // OBJ, PLY or STL; one skin, open where it is filled\n"
        "  \"formwork\": {\n"
        "    \"units\": \"m\",                            // of the mesh: \"m\", \"cm\", \"mm\", \"in\"\n"
        "    \"up\": \"z\",                               // \"y\" for meshes from Rhino or Blender with Y up\n"
        "    \"fixed\": [{\"boundary\": \"top\"}],          // the rim is held\n"
        "    \"plaster\": {\"density\": 1500,             // kg/m³\n"
        "                \"fill\": {\"depth_below_rim\": 0.005}},\n"
        "    \"inflate\": {\"material\": {\"model\": \"isotropic\", \"rest\": [300, 2, 300, 37.5], \"max\": [600, 2, 600, 75]}},\n"
        "    \"sew\": {\"material\": {\"model\": \"tensor\", \"data\": \"woven.json\"}}\n"
        "  }\n"
        "}\n"
        "// Every key of \"formwork\" with its default, meaning and unit:\n";
    explain(arcsim::schema_of<FormworkParams>(), "", text);
    return text;
}

std::string starter_material_text() {
    return "// A woven cotton, in ArcSim's format: stiffness in N/m of rows unstrained, then strained by 1/6 at 0, 22.5, 45, 67.5 and\n"
           "// 90 degrees to the warp; columns warp, coupling, weft, shear. Entries are multiplied by 2 when loaded, as ArcSim does.\n"
           "{\"density\": 0.2,\n"
           " \"stretching\": [[36496.94, 17.77, 56329.3, 3171.91], [453939.78, 24.67, 499773.53, 10794.15], [321081.07, 37.87, 643526.19, 46434.4],\n"
           "                [147439.0, 11.5, 261801.58, 13953.55], [439895.04, 52.62, 383126.43, 12605.24], [418775.97, 82.44, 488043.68, 44474.28]],\n"
           " \"bending\": [[1e-6, 1e-6, 1e-6, 1e-6, 1e-6], [1e-6, 1e-6, 1e-6, 1e-6, 1e-6], [1e-6, 1e-6, 1e-6, 1e-6, 1e-6]]}\n";
}

}  // namespace formwork
