#include <gnomon/batch/build.hpp>
#include <gnomon/batch/validate.hpp>
#include <gnomon/check/check.hpp>

#include "shapes.hpp"

using namespace gnomon;
using batch::BatchFault;

TEST_CASE("validate names what is wrong with batches", "[batch]") {
    shapes::Mesh const mesh = shapes::soup(500);
    batch::Batches const good = batch::build_batches(mesh.list(), {.max_triangles = 32});
    REQUIRE(good.batches.size() > 2);
    auto const fault_of = [&](auto const& spoil) {
        batch::Batches bad = good;
        spoil(bad);
        return validate(bad, mesh.list(), 32);
    };
    CHECK(fault_of([](auto&) {}) == BatchFault::none);
    CHECK(validate(good, mesh.list(), 4) == BatchFault::wrong_range);
    CHECK(fault_of([](auto& b) { b.batches[1].first++; }) == BatchFault::wrong_range);
    CHECK(fault_of([](auto& b) { b.triangles.push_back(0); }) == BatchFault::wrong_range);
    CHECK(fault_of([](auto& b) { b.boxes.pop_back(); }) == BatchFault::wrong_boxes);
    CHECK(fault_of([](auto& b) { b.triangles[0] = 500; }) == BatchFault::bad_triangle);
    CHECK(fault_of([](auto& b) { b.triangles[0] = b.triangles[1]; }) == BatchFault::twice);
    CHECK(fault_of([](auto& b) { std::swap(b.triangles.front(), b.triangles.back()); }) == BatchFault::mixed_groups);
    CHECK(fault_of([](auto& b) { b.boxes[1].hi.x = math::next_up(b.boxes[1].hi.x); }) == BatchFault::loose_box);
    CHECK(fault_of([](auto& b) {
              b.triangles.resize(b.batches.back().first);
              b.batches.pop_back();
              b.boxes.pop_back();
          }) == BatchFault::missing);
}
