#include <gnomon/batch/build.hpp>
#include <gnomon/batch/validate.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>

#include "naive.hpp"
#include "shapes.hpp"

#include <cmath>
#include <limits>

using namespace gnomon;
using batch::BatchFault;
using shapes::Mesh;

namespace {

bool same(batch::Batches const& a, batch::Batches const& b) {
    return a.triangles == b.triangles && a.batches == b.batches && a.boxes == b.boxes && a.left_out == b.left_out;
}

/// Runs ranges of one item, the last one first.
struct BackwardExecutor {
    template <class F>
    void parallel_for(std::size_t n, std::size_t /*grain*/, F&& f) const {
        for (std::size_t i = n; i-- > 0;) f(i, i + 1);
    }
};

/// Soups whose corners lie on a coarse grid, so that distances tie, or anywhere; up to 40 triangles of up to 3 groups.
auto small_meshes() {
    return [](check::Choices& choices) {
        Mesh mesh;
        bool const coarse = choices.draw(1) == 0;
        auto const number = [&] {
            return coarse ? static_cast<float>(check::integers(-3, 3)(choices)) : check::floats(-10.0F, 10.0F)(choices);
        };
        auto const point = [&] {
            float const x = number();
            float const y = number();
            return math::vec3(x, y, number());
        };
        std::uint64_t const groups = choices.draw(2);
        std::uint64_t const count = choices.draw(40);
        for (std::uint64_t i = 0; i < count; ++i) {
            math::vec3 const a = point();
            math::vec3 const b = a + point() * 0.25F;
            auto const group = static_cast<std::uint32_t>(choices.draw(groups));
            mesh.add(a, b, a + point() * 0.25F, group);
        }
        return mesh;
    };
}

}  // namespace

TEST_CASE("build_batches is the paper's rule done naively", "[batch][property]") {
    check::for_all(check::cases(400), small_meshes(), check::integers(1, 9), [](Mesh const& mesh, int max) {
        auto const max_triangles = static_cast<std::uint32_t>(max);
        batch::Batches const built = batch::build_batches(mesh.list(), {.max_triangles = max_triangles});
        CHECK(naive::batches_of(built) == naive::batches(mesh.list(), max_triangles));
        CHECK(validate(built, mesh.list(), max_triangles) == BatchFault::none);
        CHECK(built.hurried == 0);
    });
}

TEST_CASE("build_batches is the naive rule on hundreds of triangles, large batches and needles", "[batch]") {
    for (Mesh const& mesh : {shapes::soup(300), shapes::needles(250), shapes::town(700)})
        for (std::uint32_t const max : {16U, 128U}) {
            batch::Batches const built = batch::build_batches(mesh.list(), {.max_triangles = max});
            CHECK(naive::batches_of(built) == naive::batches(mesh.list(), max));
        }
}

TEST_CASE("build_batches is the naive rule on two thousand triangles", "[.full][batch]") {
    for (Mesh const& mesh : {shapes::soup(2000, 3), shapes::town(2500)}) {
        batch::Batches const built = batch::build_batches(mesh.list());
        CHECK(naive::batches_of(built) == naive::batches(mesh.list(), 128));
    }
}

TEST_CASE("batches hold every triangle once, of one group, and no more than the limit", "[batch]") {
    for (std::size_t const n : {0U, 1U, 2U, 7U, 8U, 9U, 63U, 64U, 65U, 513U, 6000U})
        for (std::uint32_t const max : {1U, 3U, 128U}) {
            Mesh const mesh = shapes::soup(n, n);
            batch::Batches const built = batch::build_batches(mesh.list(), {.max_triangles = max});
            CAPTURE(n);
            CHECK(validate(built, mesh.list(), max) == BatchFault::none);
            CHECK(built.triangles.size() == n);
            CHECK((max != 1 || built.batches.size() == n));
        }
}

TEST_CASE("batches do not depend on the executor", "[batch]") {
    Mesh mesh = shapes::soup(3000);
    for (std::size_t i = 0; i < mesh.groups.size(); ++i) mesh.groups[i] = static_cast<std::uint32_t>(i * i % 11);
    batch::Batches const serial = batch::build_batches(mesh.list());
    batch::Workspace workspace;
    batch::Batches other;
    core::ThreadExecutor const threads(3);
    build_batches(mesh.list(), {}, workspace, other, threads);
    CHECK(same(serial, other));
    BackwardExecutor const backward;
    build_batches(mesh.list(), {}, workspace, other, backward);
    CHECK(same(serial, other));
}

TEST_CASE("batches of a town have less than half the area of a cut of the curve, at a fill above 0.4", "[batch]") {
    Mesh const mesh = shapes::town(20'000);
    batch::Batches const built = batch::build_batches(mesh.list());
    auto const area = [](math::Aabb const& box) {
        math::dvec3 const e = math::to_double(box.hi) - math::to_double(box.lo);
        return e.x * e.y + e.y * e.z + e.z * e.x;
    };
    std::vector<batch::detail::Key> keys;
    core::SerialExecutor const serial;
    static_cast<void>(batch::detail::collect(mesh.list(), keys, serial));
    double cut = 0.0;
    for (std::size_t i = 0; i < keys.size(); i += 128) {
        math::Aabb bounds;
        for (std::size_t k = i; k < std::min(i + 128, keys.size()); ++k) {
            math::Aabb box;
            static_cast<void>(batch::bounds_of_triangle(mesh.list(), keys[k].triangle, box));
            bounds = math::merged(bounds, box);
        }
        cut += area(bounds);
    }
    double ours = 0.0;
    for (math::Aabb const& box : built.boxes) ours += area(box);
    CHECK(ours < 0.5 * cut);
    CHECK(static_cast<double>(mesh.list().size()) > 0.4 * 128.0 * static_cast<double>(built.batches.size()));
}

TEST_CASE("a search that gives up is counted, and its batches are batches", "[batch]") {
    Mesh const mesh = shapes::needles(3000);
    for (std::uint32_t const visits : {1U, 2U, 20U}) {
        batch::Batches const built = batch::build_batches(mesh.list(), {.max_triangles = 32, .max_visits = visits});
        CHECK(built.hurried > 0);
        CHECK(validate(built, mesh.list(), 32) == BatchFault::none);
    }
}

TEST_CASE("equal, collinear, pointlike, denormal and huge triangles are triangles", "[batch][degenerate]") {
    float const most = std::numeric_limits<float>::max();
    float const least = std::numeric_limits<float>::denorm_min();
    math::vec3 const o(0.0F, 0.0F, 0.0F);
    for (math::vec3 const& p : {o, math::vec3(1.0F, 2.0F, 3.0F), math::vec3(most, -most, most), math::vec3(1e30F, 0.0F, least)})
        for (math::vec3 const& q : {o, p, math::vec3(least, least, -least), math::vec3(-most, most, -most)}) {
            Mesh mesh;
            for (int i = 0; i < 1000; ++i) mesh.add(p, q, i % 3 == 0 ? p : o);
            batch::Batches const built = batch::build_batches(mesh.list());
            CHECK(validate(built, mesh.list(), 128) == BatchFault::none);
            CHECK(built.triangles.size() == 1000);
        }
}

TEST_CASE("1000 equal triangles fill their batches", "[batch][degenerate]") {
    Mesh mesh;
    for (int i = 0; i < 1024; ++i)
        mesh.add(math::vec3(1.0F, 0.0F, 0.0F), math::vec3(0.0F, 1.0F, 0.0F), math::vec3(0.0F, 0.0F, 1.0F));
    CHECK(batch::build_batches(mesh.list(), {.max_triangles = 1024}).batches.size() == 1);
    // All distances tie: the lowest slot takes one triangle after the other, and then is too large for the rest.
    CHECK(naive::batches_of(batch::build_batches(mesh.list())).front().size() == 128);
}

TEST_CASE("a NaN, an infinity and a bad index cost their own triangle, and nothing else changes", "[batch][degenerate]") {
    Mesh const whole = shapes::soup(2000);
    batch::Batches const expected = batch::build_batches(whole.list());
    Mesh mesh = whole;
    float const bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity()};
    for (float const x : bad) mesh.add(math::vec3(0.0F, x, 0.0F), math::vec3(1.0F, 0.0F, 0.0F), math::vec3(0.0F, 0.0F, 1.0F));
    mesh.indices.insert(mesh.indices.end(), {0, 1, static_cast<std::uint32_t>(mesh.positions.size())});
    mesh.groups.push_back(1);
    batch::Batches const built = batch::build_batches(mesh.list());
    CHECK(built.left_out == batch::LeftOut{1, 3});
    CHECK(built.triangles == expected.triangles);
    CHECK(built.boxes == expected.boxes);
    CHECK(validate(built, mesh.list(), 128) == BatchFault::none);
}

TEST_CASE("one triangle at 1e30 leaves the batches of the others as they are", "[batch][degenerate]") {
    Mesh mesh = shapes::soup(30'000);  // in no order: a curve that is too coarse would have to be searched from end to end
    for (std::uint32_t& group : mesh.groups) group = 0;
    auto const without = naive::batches_of(batch::build_batches(mesh.list()));
    mesh.add(math::vec3(1e30F, -1e30F, 1e30F), math::vec3(1e30F, -1e30F, 1e30F), math::vec3(1e30F, -1e30F, 1e29F));
    batch::Batches const built = batch::build_batches(mesh.list());
    auto with = naive::batches_of(built);
    CHECK(built.hurried == 0);
    CHECK(with.back() == std::vector<std::uint32_t>{30'000});
    with.pop_back();
    CHECK(with == without);
}
