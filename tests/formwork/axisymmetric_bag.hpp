#pragma once

#include <string>

#include "formwork/fabric/material_params.hpp"

/// Filled bags and troughs as ordinary differential equations, solved by shooting: an oracle without triangles for any
/// size, fill and stiffness, where the stored references have a few. Laws: `isotropic`, constant or secant, written down anew.
namespace axisymmetric {

struct Bag {
    std::string kind = "disk";                     // disk, hemisphere or sock, as reference b6 has them
    double radius = 0.1, height = 0;               // m
    formwork::MaterialParams fabric;               // full compression
    double rho_g = 0, head = 0;                    // N/m³; level above the rim, m
    double pressure = 0;                           // Pa, uniform
};

struct Shape {
    bool found = false;
    double depth = 0;             // of the pole below the rim, m
    double volume = 0;            // up to the rim's plane, m³
    double reaction = 0;          // vertical force of the pressure, N
    double pole_stretch = 1;
    double least_tension = 0;     // of the hoops, N per rest metre: below zero the fabric would wrinkle
};

/// @param guess  depth and pole_stretch to shoot from
Shape solve(const Bag& bag, const Shape& guess);

struct Trough {
    double width = 0.4, length = 0.5;   // W apart, L of cloth, m
    formwork::MaterialParams fabric;
    double rho_g = 0, head = 0;
};

struct Section {
    bool found = false;
    double depth = 0, tension = 0, area = 0, stretch = 1;   // m; N/m; of the liquid, m²
};

/// @param guess  depth and stretch to shoot from
Section solve(const Trough& trough, const Section& guess);

}  // namespace axisymmetric
