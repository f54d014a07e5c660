#include "formwork/stages/strain_file.hpp"

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "formwork/stages/csv.hpp"

namespace formwork {

using arcsim::InputError;

void write_strain(const std::filesystem::path& folder, const StrainField& strain) {
    CsvText csv("face,lambda1,lambda2,dir_x,dir_y,dir_z,eps_uu,eps_vv,eps_uv,state");
    CsvText tension("face,tension1,tension2,dir_x,dir_y,dir_z");
    for (std::size_t f = 0; f < strain.size(); ++f) {
        const FaceStrain& s = strain[f];
        csv.add(static_cast<int>(f)).add(s.lambda1).add(s.lambda2).add(s.dir[0]).add(s.dir[1]).add(s.dir[2]);
        csv.add(s.eps_uu).add(s.eps_vv).add(s.eps_uv).add(to_string(s.state)).end_row();
        tension.add(static_cast<int>(f)).add(s.tension1).add(s.tension2);
        tension.add(s.dir_deformed[0]).add(s.dir_deformed[1]).add(s.dir_deformed[2]).end_row();
    }
    arcsim::write_file_atomically(folder / "strain.csv", csv.text());
    arcsim::write_file_atomically(folder / "tension.csv", tension.text());
}

StrainField read_strain(const std::filesystem::path& folder, int n_faces) {
    const CsvFile csv(folder / "strain.csv", {"face", "lambda1", "lambda2", "dir_x", "dir_y", "dir_z", "eps_uu", "eps_vv", "eps_uv", "state"});
    const CsvFile tension(folder / "tension.csv", {"face", "tension1", "tension2", "dir_x", "dir_y", "dir_z"});
    if (csv.n_rows() != n_faces || tension.n_rows() != n_faces)
        throw InputError((folder / "strain.csv").string() + ": has " + std::to_string(csv.n_rows()) + " faces, the mesh has " +
                         std::to_string(n_faces) + ". Run inflate again for this mesh.");
    StrainField strain(n_faces);
    for (int f = 0; f < n_faces; ++f) {
        FaceStrain& s = strain[csv.integer(f, 0, 0, n_faces)];
        s.lambda1 = csv.number(f, 1), s.lambda2 = csv.number(f, 2);
        s.dir = {csv.number(f, 3), csv.number(f, 4), csv.number(f, 5)};
        s.eps_uu = csv.number(f, 6), s.eps_vv = csv.number(f, 7), s.eps_uv = csv.number(f, 8);
        const std::string& state = csv.text(f, 9);
        s.state = state == "taut" ? FaceState::taut : state == "wrinkled" ? FaceState::wrinkled : FaceState::slack;
        s.tension1 = tension.number(f, 1), s.tension2 = tension.number(f, 2);
        s.dir_deformed = {tension.number(f, 3), tension.number(f, 4), tension.number(f, 5)};
    }
    return strain;
}

}  // namespace formwork
