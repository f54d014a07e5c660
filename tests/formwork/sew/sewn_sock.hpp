#pragma once

#include "formwork/sew/sew.hpp"
#include "tests/formwork/cut_surfaces.hpp"
#include "tests/formwork/shapes.hpp"

/// A sock whose wall is cut along four meridians and along the bottom's edge, warp upwards: small, and every
/// number of its weave can be argued about.
struct SewnSock {
    shapes::Bag bag;
    formwork::Segmentation cut;
    std::vector<formwork::FlatPanel> panels;

    SewnSock(double radius, double height, int rings);
    /// Another bag, cut by labels; the warp runs up where it can, along x in faces that face down.
    SewnSock(shapes::Bag bag, const std::vector<int>& label);
    /// `inflated` starts as the rest shape.
    formwork::SewInput input(double level) const;
    static formwork::SewParams params();
};
