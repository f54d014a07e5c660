#include "formwork/report/vtu.hpp"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "arcsim/base/files.hpp"

namespace formwork {
namespace {

/// The appended part of the file: each array a header of 64 bit counts and zlib blocks, named by
/// its offset.
class Appended {
public:
    template <class T>
    std::uint64_t add(const std::vector<T>& values) {
        const std::uint64_t offset = bytes_.size();
        constexpr std::uint64_t block = 1 << 18;
        const char* data = reinterpret_cast<const char*>(values.data());
        const std::uint64_t size = values.size() * sizeof(T);
        const std::uint64_t n_blocks = (size + block - 1) / block;
        std::vector<std::uint64_t> header{n_blocks, block, size % block};
        std::string packed;
        for (std::uint64_t i = 0; i < n_blocks; ++i) {
            const std::uint64_t n = std::min(block, size - i * block);
            uLongf room = compressBound(n);
            std::string one(room, '\0');
            if (compress2(reinterpret_cast<Bytef*>(one.data()), &room,
                          reinterpret_cast<const Bytef*>(data + i * block), n, 6) != Z_OK)
                throw std::runtime_error("zlib: no memory for a VTU file");
            header.push_back(room);
            packed.append(one, 0, room);
        }
        bytes_.append(reinterpret_cast<const char*>(header.data()),
                      header.size() * sizeof(std::uint64_t));
        bytes_ += packed;
        return offset;
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

void describe(std::ostream& xml, const char* type, const std::string& name, int components,
              std::uint64_t offset) {
    xml << "        <DataArray type=\"" << type << "\" Name=\"" << name
        << "\" NumberOfComponents=\"" << components << "\" format=\"appended\" offset=\"" << offset
        << "\"/>\n";
}

void add_data(std::ostream& xml, Appended& appended, const char* tag,
              const std::vector<VtuArray>& arrays, size_t n) {
    xml << "      <" << tag << ">\n";
    for (const VtuArray& a : arrays) {
        if (a.values.size() != n * a.components)
            throw std::invalid_argument("write_vtu: " + a.name + " does not fit its mesh");
        describe(xml, "Float32", a.name, a.components,
                 appended.add(std::vector<float>(a.values.begin(), a.values.end())));
    }
    xml << "      </" << tag << ">\n";
}

template <class Member>
VtuArray scalar_array(const char* name, const StrainField& strain, Member member) {
    VtuArray a{name, 1, {}};
    for (const FaceStrain& s : strain) a.values.push_back(member(s));
    return a;
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Surface& s,
               const std::vector<VtuArray>& node_data, const std::vector<VtuArray>& face_data) {
    Appended appended;
    std::ostringstream xml;
    xml << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
           "byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n   "
           " <Piece NumberOfPoints=\""
        << s.n_nodes() << "\" NumberOfCells=\"" << s.n_faces() << "\">\n";
    add_data(xml, appended, "PointData", node_data, s.x.size());
    add_data(xml, appended, "CellData", face_data, s.faces.size());

    std::vector<double> points;
    for (const arcsim::Vector3d& p : s.x) points.insert(points.end(), {p.x(), p.y(), p.z()});
    std::vector<std::int32_t> corners, ends;
    for (const arcsim::Triangle& t : s.faces) {
        corners.insert(corners.end(), {t[0], t[1], t[2]});
        ends.push_back(static_cast<std::int32_t>(corners.size()));
    }
    constexpr std::uint8_t triangle = 5;  // VTK_TRIANGLE
    xml << "      <Points>\n";
    describe(xml, "Float64", "Points", 3, appended.add(points));
    xml << "      </Points>\n      <Cells>\n";
    describe(xml, "Int32", "connectivity", 1, appended.add(corners));
    describe(xml, "Int32", "offsets", 1, appended.add(ends));
    describe(xml, "UInt8", "types", 1,
             appended.add(std::vector<std::uint8_t>(s.faces.size(), triangle)));
    xml << "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData "
           "encoding=\"raw\">\n_";
    arcsim::write_file_atomically(
        path, xml.str() + appended.bytes() + "\n  </AppendedData>\n</VTKFile>\n");
}

void write_pvd(const std::filesystem::path& path,
               const std::vector<std::pair<double, std::string>>& frames) {
    std::ostringstream xml;
    xml.precision(12);
    xml << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
           "byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (const auto& [time, file] : frames)
        xml << "    <DataSet timestep=\"" << time << "\" group=\"\" part=\"0\" file=\"" << file
            << "\"/>\n";
    xml << "  </Collection>\n</VTKFile>\n";
    arcsim::write_file_atomically(path, xml.str());
}

std::vector<VtuArray> strain_arrays(const StrainField& strain) {
    std::vector<arcsim::Vector3d> rest, deformed;
    for (const FaceStrain& s : strain) rest.push_back(s.dir), deformed.push_back(s.dir_deformed);
    return {scalar_array("lambda1", strain, [](const FaceStrain& s) { return s.lambda1; }),
            scalar_array("lambda2", strain, [](const FaceStrain& s) { return s.lambda2; }),
            vector_array("direction", rest),
            vector_array("direction_deformed", deformed),
            scalar_array("eps_uu", strain, [](const FaceStrain& s) { return s.eps_uu; }),
            scalar_array("eps_vv", strain, [](const FaceStrain& s) { return s.eps_vv; }),
            scalar_array("eps_uv", strain, [](const FaceStrain& s) { return s.eps_uv; }),
            scalar_array("tension1", strain, [](const FaceStrain& s) { return s.tension1; }),
            scalar_array("tension2", strain, [](const FaceStrain& s) { return s.tension2; }),
            scalar_array("state", strain,
                         [](const FaceStrain& s) { return static_cast<double>(s.state); })};
}

VtuArray vector_array(std::string name, const std::vector<arcsim::Vector3d>& v) {
    VtuArray a{std::move(name), 3, {}};
    for (const arcsim::Vector3d& p : v) a.values.insert(a.values.end(), {p.x(), p.y(), p.z()});
    return a;
}

VtuArray integer_array(std::string name, const std::vector<int>& v) {
    return {std::move(name), 1, std::vector<double>(v.begin(), v.end())};
}

}  // namespace formwork
