#pragma once
// The predicates compiled once more, for a machine with FMA and with contraction on; see contracted.test.cpp.

#include "exact_oracle.hpp"

namespace contracted {

/// This program holds the second build, and this machine can run it.
bool is_available();

int orient2d(float ax, float ay, float bx, float by, float cx, float cy);
int orient3d(oracle::Point const& a, oracle::Point const& b, oracle::Point const& c, oracle::Point const& d,
             bool at_infinity);
int line_side(oracle::Point const& start, oracle::Point const& end, bool at_infinity, oracle::Point const& a,
              oracle::Point const& b);
int edge_plane_side(oracle::Point const& p, oracle::Point const& light, bool at_infinity, oracle::Point const& a,
                    oracle::Point const& b);
/// 1 if a rounded product and sum are fused here: proof that the build is what it claims to be.
int fuses(double a, double b, double c);

}  // namespace contracted
