#include <gnomon/check/check.hpp>
#include <gnomon/cluster/make_keys.hpp>
#include <gnomon/cluster/reduce.hpp>
#include <gnomon/cluster/unique.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;

/// A picture of smooth depths with steps and holes, out of integers alone: the same floats on every machine.
struct HashedPicture {
    cluster::Grid grid;
    std::vector<float> depth_m;
    std::vector<math::vec3> normals;
};

HashedPicture hashed_picture(int width, int height, std::uint32_t seed) {
    math::View view;
    view.window = {-1.25, 1.125, -0.625, 0.75};
    view.near_m = 0.125;
    view.size_px = {width, height};
    HashedPicture p{cluster::make_grid(view, math::ivec2(32, 24), cluster::make_cubical_slices(view, 24, 500.0).value()).value(), {}, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            seed = seed * 1664525U + 1013904223U;
            auto const at = static_cast<float>(4 + x * 3 + y) * 0.25F;
            bool const step = (x / 13 + y / 7) % 5 == 0;
            float const noise = static_cast<float>(seed >> 8U) * 0x1p-24F;
            p.depth_m.push_back(seed % 97 == 0 ? std::numeric_limits<float>::infinity() : step ? at * 0.125F : at + noise);
            p.normals.push_back(math::vec3(noise - 0.5F, static_cast<float>(x % 17) * 0.1F - 0.8F, step ? 1.0F : -0.7F));
        }
    return p;
}

class Hash {
public:
    void add(std::uint32_t word) { value_ = (value_ ^ word) * 0x100000001B3ULL; }
    void add(float x) { add(std::bit_cast<std::uint32_t>(x)); }
    void add(math::vec3 const& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

}  // namespace

TEST_CASE("the keys of an image are those of its samples one by one, for any executor", "[cluster][property]") {
    check::for_all(check::cases(20), check::integers(1, 300), check::integers(1, 100), check::integers(0U, 3U), check::integers(0U, 100U),
                   [](int width, int height, std::uint32_t normal_n, std::uint32_t seed) {
                       HashedPicture p = hashed_picture(width, height, seed);
                       p.depth_m[p.depth_m.size() / 2] = std::numeric_limits<float>::quiet_NaN();
                       p.depth_m[p.depth_m.size() / 3] = -1.0F;
                       auto const layout = cluster::make_key_layout<std::uint64_t>(p.grid.view(), normal_n).value();
                       std::vector<std::uint64_t> keys(p.depth_m.size());
                       std::vector<std::uint64_t> by_threads(keys.size());
                       make_keys(p.grid, layout, {p.depth_m, p.normals}, std::span<std::uint64_t>(keys));
                       for (std::size_t i = 0; i < keys.size(); ++i) {
                           auto const x = static_cast<std::uint32_t>(i % static_cast<std::size_t>(width));
                           auto const y = static_cast<std::uint32_t>(i / static_cast<std::size_t>(width));
                           bool const there = math::is_finite(p.depth_m[i]);
                           CHECK(keys[i] == (there ? key_at(p.grid, layout, math::uvec2(x, y), p.depth_m[i], p.normals[i])
                                                   : cluster::no_key<std::uint64_t>));
                       }
                       core::ThreadExecutor const threads(3);
                       make_keys(p.grid, layout, {p.depth_m, p.normals}, std::span<std::uint64_t>(by_threads), threads);
                       CHECK(by_threads == keys);
                   });
}

TEST_CASE("planes, keys, unique clusters and bounds of a picture have the bits of every compiler", "[cluster][golden]") {
    HashedPicture const p = hashed_picture(640, 360, 5);
    auto const layout = cluster::make_key_layout<std::uint32_t>(p.grid.view(), 3).value();
    std::vector<std::uint32_t> keys(p.depth_m.size());
    std::vector<std::uint32_t> found(keys.size());
    std::vector<std::uint32_t> index(keys.size());
    make_keys(p.grid, layout, {p.depth_m, p.normals}, std::span<std::uint32_t>(keys));
    cluster::UniqueWorkspace<std::uint32_t> work;
    auto const stats = unique_by_bitmap(layout, std::span<std::uint32_t const>(keys), {found, index}, work);
    std::vector<math::vec3> positions;
    for (std::size_t i = 0; i < keys.size(); ++i)
        positions.push_back(position_at(p.grid, math::vec2(static_cast<float>(i % 640) + 0.5F, static_cast<float>(i / 640) + 0.5F), p.depth_m[i]));
    std::vector<math::Aabb> boxes(stats.clusters);
    std::vector<cluster::NormalCone> cones(stats.clusters);
    cluster::ReduceWorkspace reduce_work;
    CHECK(cluster::explicit_bounds(index, positions, boxes, reduce_work) == cluster::ReduceStats{});
    CHECK(cluster::explicit_cones(index, p.normals, cones, reduce_work) == cluster::ReduceStats{});
    Hash hash;
    for (float const plane : p.grid.view().depth_m) hash.add(plane);
    for (float const x : p.grid.view().x) hash.add(x);
    for (float const y : p.grid.view().y) hash.add(y);
    for (std::size_t c = 0; c < stats.clusters; ++c) {
        hash.add(found[c]);
        hash.add(boxes[c].lo);
        hash.add(boxes[c].hi);
        hash.add(cones[c].axis);
        hash.add(cones[c].cos_half);
        auto const parts = cluster::unpack_key(found[c]);
        auto const implicit = implicit_bounds(p.grid.view(), {parts.column, parts.row, parts.slice});
        if (!contains(implicit, boxes[c].lo) || !contains(implicit, boxes[c].hi)) FAIL("explicit bounds leave the implicit ones");
        hash.add(implicit.hi);
        auto const cell = cluster::cone_of_cell(parts.cell, 3);
        hash.add(cell.axis);
        hash.add(cell.cos_half);
    }
    for (std::uint32_t const i : index) hash.add(i);
    CHECK(stats.clusters == 14030);
    CHECK(hash.value() == 14997977673385040265ULL);
}
