#include <gnomon/batch/build.hpp>
#include <gnomon/batch/refit.hpp>
#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>

#include "shapes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

GNOMON_COUNT_ALLOCATIONS;

using namespace gnomon;

namespace {

/// Bounds of a batch, from the definition.
math::Aabb bounds_from_scratch(batch::Batches const& batches, std::size_t b, shapes::Mesh const& mesh) {
    math::Aabb box;
    for (std::size_t i = 0; i < batches.batches[b].count; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            math::vec3 const& p = mesh.positions[mesh.indices[3 * batches.triangles[batches.batches[b].first + i] + k]];
            for (math::axis_t axis = 0; axis < 3; ++axis) {
                box.lo[axis] = std::min(box.lo[axis], p[axis]);
                box.hi[axis] = std::max(box.hi[axis], p[axis]);
            }
        }
    return box;
}

}  // namespace

TEST_CASE("refit gives the exact bounds of moved triangles, for any executor, and allocates nothing", "[batch]") {
    shapes::Mesh mesh = shapes::soup(4000);
    batch::Batches const batches = batch::build_batches(mesh.list());
    std::vector<math::Aabb> boxes(batches.batches.size());
    std::vector<math::Aabb> by_threads(boxes.size());
    core::ThreadExecutor const threads(3);
    shapes::Random random{5};
    for (int frame = 0; frame < 3; ++frame) {
        for (math::vec3& p : mesh.positions) p = p * 1.01F + random.point(-0.5F, 0.5F);
        std::uint64_t const before = check::allocations_made();
        std::uint64_t const lost = refit(batches, mesh.list(), boxes);
        CHECK(check::allocations_made() == before);
        CHECK(lost == 0);
        std::size_t wrong = 0;
        for (std::size_t b = 0; b < boxes.size(); ++b) wrong += boxes[b] == bounds_from_scratch(batches, b, mesh) ? 0U : 1U;
        CHECK(wrong == 0);
        static_cast<void>(refit(batches, mesh.list(), by_threads, threads));
        CHECK(by_threads == boxes);
    }
}

TEST_CASE("refit counts triangles that are not finite now, and leaves them out", "[batch][degenerate]") {
    shapes::Mesh mesh;
    mesh.add(math::vec3(0.0F, 0.0F, 0.0F), math::vec3(1.0F, 0.0F, 0.0F), math::vec3(0.0F, 1.0F, 0.0F));
    mesh.add(math::vec3(0.0F, 0.0F, 1.0F), math::vec3(1.0F, 0.0F, 1.0F), math::vec3(0.0F, 1.0F, 1.0F));
    batch::Batches const batches = batch::build_batches(mesh.list());
    REQUIRE(batches.batches.size() == 1);
    std::vector<math::Aabb> boxes(1);
    mesh.positions[4].x = std::numeric_limits<float>::quiet_NaN();
    CHECK(refit(batches, mesh.list(), boxes) == 1);
    CHECK(boxes[0] == math::Aabb{math::vec3(0.0F, 0.0F, 0.0F), math::vec3(1.0F, 1.0F, 0.0F)});
    mesh.positions[0].y = -std::numeric_limits<float>::infinity();
    CHECK(refit(batches, mesh.list(), boxes) == 2);
    CHECK(is_empty(boxes[0]));
}

TEST_CASE("a second build with the same workspace allocates nothing", "[batch]") {
    shapes::Mesh mesh = shapes::soup(3000);
    batch::Workspace workspace;
    batch::Batches out;
    core::SerialExecutor const serial;
    build_batches(mesh.list(), {}, workspace, out, serial);
    std::uint64_t const before = check::allocations_made();
    build_batches(mesh.list(), {}, workspace, out, serial);
    CHECK(check::allocations_made() == before);
}
