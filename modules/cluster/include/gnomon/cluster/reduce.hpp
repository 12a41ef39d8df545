#pragma once
// Explicit bounds of clusters by reduction over their samples: boxes, position bits, normal cones.
//
// All of them are least or greatest values, or ORs: what order samples and threads come in makes no difference.
//
// source: [Olsson 2014, Paper II, 3.2, 4.2; Paper III, 4.4]

#include <gnomon/cluster/bounds.hpp>
#include <gnomon/cluster/detail/serial.hpp>
#include <gnomon/cluster/key.hpp>
#include <gnomon/cluster/normal_cells.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/bounds.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::cluster {

/// What a reduction left out. A sample of no cluster is neither.
struct ReduceStats {
    std::size_t not_finite = 0;  ///< Samples with a NaN or an infinity, or normals of no length.
    std::size_t outside = 0;     ///< Samples whose index is beyond the clusters given, or outside of the box given.

    friend bool operator==(ReduceStats const&, ReduceStats const&) noexcept = default;
};

/// Memory of the reductions: grows to the clusters, then nothing is allocated.
struct ReduceWorkspace {
    std::vector<std::int32_t> places;  ///< Six a cluster: places of floats in their order.
};

/// The box of each cluster's samples, exact; empty where it has none.
///
/// expects: as many positions as indices; an index is a cluster's, or `no_cluster`
/// returns: what was left out. Zeros are +0.
/// source:  [Olsson 2014, Paper II, 3.2]: explicit bounds
template <core::Executor E = core::SerialExecutor const>
ReduceStats explicit_bounds(std::span<std::uint32_t const> index, std::span<math::vec3 const> positions,
                            std::span<math::Aabb> out, ReduceWorkspace& work, E& executor = detail::serial);

/// The position bits of each cluster's samples in its implicit box; 0 where it has none.
///
/// expects: as `explicit_bounds`; `implicit` has a box for each of `out`
/// returns: what was left out: a sample outside of its box too, whose bits would not hold it. A box with some slack
///          (`implicit_bounds`) has none outside.
/// source:  [Olsson 2014, Paper III, 4.4]
template <core::Executor E = core::SerialExecutor const>
ReduceStats reduce_position_bits(std::span<std::uint32_t const> index, std::span<math::vec3 const> positions,
                                 std::span<math::Aabb const> implicit, std::span<PositionBits> out, E& executor = detail::serial);

/// A cone that holds the normals of each cluster's samples: its axis is the middle of their box, its cosine the least
/// of any to it, computed in double and rounded down. Exact normals are within it, in exact arithmetic:
///
///     the cosine in double errs by less than 20 * 2^-53 = 2.3e-15 (two sums of three exact products, their product,
///     the comparison's, a quotient, a root); 4e-15 is taken off before it is rounded down
///
/// expects: as `explicit_bounds`; normals of any length
/// returns: what was left out. A cluster without samples has an empty cone (cosine 2); one with a normal that has no
///          direction, or whose normals' box is centred on zero, has all directions (cosine -1).
/// source:  [Olsson 2014, Paper II, 3.2, 3.3]: explicit normal cones
template <core::Executor E = core::SerialExecutor const>
ReduceStats explicit_cones(std::span<std::uint32_t const> index, std::span<math::vec3 const> normals,
                           std::span<NormalCone> out, ReduceWorkspace& work, E& executor = detail::serial);

}  // namespace gnomon::cluster

#include <gnomon/cluster/detail/reduce.hpp>
