#pragma once
// Light lists made on a backend, compared with the host's step by step: keys, unique clusters, bounds, tree, lists.

#include "../src/lighting/lighting.hpp"

#include <gnomon/bvh.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/cluster.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace gnomon::test {

/// Six scenes, of which some bring lights. 4 x 4 parts a face of normals do not fit a key of 32 bits.
struct DeviceScene {
    char const* name;
    char const* camera;  ///< Empty: the first.
    char const* lights;
    std::uint32_t normal_n = 0;
    double offset_m = 0.0;  ///< All of it moved along x, y and z.
};
inline constexpr DeviceScene far_scene{"atrium", "still", "300", 0, 1e7};
inline constexpr DeviceScene device_scenes[] = {{"atrium", "still", "300", 0}, {"robots", "", "many", 3}, {"necropolis", "", "", 0},
                                                {"city", "", "", 1},           {"forest", "", "", 0},     {"houses", "", "", 4}};

enum class DeviceView { plain, orthographic, off_centre };

/// A frame and lights: the scene's own, and as many scattered about it as are asked for.
class DeviceFrame {
  public:
    DeviceFrame(DeviceScene const& from, math::ivec2 size_px, std::size_t scattered, DeviceView kind = DeviceView::plain) {
        auto made_scene = scene::make_procedural({.name = from.name, .lights = from.lights});
        INFO((made_scene ? std::string() : made_scene.failure().message));
        REQUIRE(made_scene.has_value());
        scene_ = std::move(made_scene).value();
        geometry_ = scene::flatten(scene_);
        math::dvec3 const offset(from.offset_m);
        geometry_.origin_m = geometry_.origin_m + offset;
        for (scene::Light& light : scene_.lights) light.position_m = light.position_m + offset;
        scene::Camera const* camera = &scene_.cameras.front();
        for (scene::Camera const& c : scene_.cameras)
            if (c.name == from.camera) camera = &c;
        math::View view = scene::make_view(*camera, size_px).value();
        view.eye_m = view.eye_m + offset;
        if (kind == DeviceView::off_centre) {
            double const width = view.window.right - view.window.left;
            view.window.left += 0.31 * width;  // and of a jittered pixel
            view.window.right += 0.31 * width;
            view.window.top -= 0.37 * width / size_px.x;
            view.window.bottom -= 0.37 * width / size_px.x;
            view.depth = math::Depth::forward;
        }
        if (kind == DeviceView::orthographic) {
            view.lens = math::Lens::orthographic;
            view.window = {-10.0, 10.0, -6.0, 6.0};
            view.near_m = -2.0;
            view.far_m = 60.0;
        }
        core::SerialExecutor serial;
        auto made = pipeline::make_frame(scene_, geometry_, {view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr}, serial);
        REQUIRE(made.has_value());
        frame = std::move(made).value();
        REQUIRE(frame.samples.size() > 100);
        lights = scene_.lights;
        scatter(scattered);
    }
    DeviceFrame(DeviceFrame const&) = delete;
    DeviceFrame& operator=(DeviceFrame const&) = delete;

    pipeline::Frame frame;
    std::vector<pipeline::Light> lights;

  private:
    /// Points and spots beside samples, or around and behind the eye; some huge, some on each other, some suns, some no lights.
    void scatter(std::size_t count) {
        std::uint64_t state = 1;
        auto const unit = [&state] {
            state = state * 6364136223846793005ULL + 1442695040888963407ULL;
            return static_cast<double>(state >> 40U) * 0x1p-24;
        };
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t const at = static_cast<std::size_t>(unit() * static_cast<double>(frame.samples.size() - 1));
            math::dvec3 const place = math::to_double(frame.samples.position[at]) + frame.geometry->origin_m;
            double const depth = glm::dot(place - frame.view.eye_m, -frame.view.back);
            double const size = std::max(0.5, std::abs(depth) * 0.1);
            double const x = unit() - 0.5;
            double const y = unit() - 0.5;
            double const z = unit() - 0.5;
            double const range = size * (i % 37 == 0 ? 20.0 : 0.2 + unit());
            pipeline::Light light = pipeline::bulb(place + math::dvec3(x, y, z) * size, static_cast<float>(range));
            if (i % 3 == 1) {
                light.kind = pipeline::LightKind::spot;
                light.direction = math::dvec3(z, x, y);
                light.outer_cone_rad = static_cast<float>(0.05 + 2.0 * unit());
                light.inner_cone_rad = light.outer_cone_rad * 0.5F;
            }
            if (i % 23 == 5) light.position_m = frame.view.eye_m + math::dvec3(x, y, z) * (i % 2 == 0 ? range : 2.0 * range);
            if (i % 50 == 7) light.position_m = lights.back().position_m;
            if (i % 101 == 50) light.range_m = std::numeric_limits<float>::quiet_NaN();
            if (i % 89 == 11) light.kind = pipeline::LightKind::directional;
            lights.push_back(light);
        }
    }

    scene::Scene scene_;
    scene::Geometry geometry_;
};

/// What a buffer begins with.
template <class T>
std::vector<T> read_back(backend::Backend& device, backend::BufferId buffer, std::size_t count) {
    std::vector<T> out(count);
    if (count == 0) return out;
    REQUIRE(device.read(buffer, 0, std::as_writable_bytes(std::span(out))).has_value());
    REQUIRE(device.finish().has_value());
    return out;
}

template <class T>
bool same_bits(std::vector<T> const& a, std::vector<T> const& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// What the host makes.
struct HostLists {
    std::vector<std::uint32_t> keys, unique, index;
    std::vector<math::Aabb> bounds;
    bvh::SphereTree tree;
    std::vector<lights::Cell> cells;
    std::vector<std::uint32_t> list;
    lights::ListsReport report;

    explicit HostLists(pipeline::DeviceListsInput const& in) {
        find_clusters(in);
        build_tree(in);
        assign(in);
    }

  private:
    void find_clusters(pipeline::DeviceListsInput const& in) {
        pipeline::SampleDepth const depth(in.frame);
        auto const width = static_cast<std::uint32_t>(in.frame.view.size_px.x);
        auto const layout = cluster::make_key_layout<std::uint64_t>(in.grid.view(), in.layout.counts.normal_n).value();
        auto const narrow = [&](std::uint64_t key) { return in.layout.key(cluster::unpack_key(key)); };
        std::vector<std::uint64_t> wide;
        std::vector<math::vec3> places;
        formula::Vec3<float> const right(math::to_float(in.frame.view.right)), down(math::to_float(-in.frame.view.up)), ahead(depth.forward());
        for (std::size_t i = 0; i < in.frame.samples.size(); ++i) {
            math::vec3 const position = in.frame.samples.position[i];
            math::uvec2 const pixel(in.frame.samples.pixel[i] % width, in.frame.samples.pixel[i] / width);
            wide.push_back(cluster::key_at(in.grid, layout, pixel, depth(position), in.frame.samples.normal[i]));
            keys.push_back(narrow(wide.back()));
            formula::Vec3<float> const offset(position - depth.eye());
            places.push_back(math::vec3(gn_along(offset, right).v, gn_along(offset, down).v, gn_along(offset, ahead).v));
        }
        std::vector<std::uint64_t> found(keys.size());
        index.resize(keys.size());
        cluster::UniqueWorkspace<std::uint64_t> work;
        auto const stats = cluster::unique_by_local_sort(layout, std::span<std::uint64_t const>(wide), {found, index}, work);
        for (std::size_t i = 0; i < stats.clusters; ++i) unique.push_back(narrow(found[i]));
        bounds.resize(stats.clusters);
        cluster::ReduceWorkspace reduce;
        (void)cluster::explicit_bounds(index, places, bounds, reduce);
    }
    void build_tree(pipeline::DeviceListsInput const& in) {
        tree = lights::build_light_tree(in.lights, ~0U).tree;
    }
    void assign(pipeline::DeviceListsInput const& in) {
        cluster::GridView const view = in.grid.view();
        std::vector<lights::Cell> dense(view.clusters());
        lights::Workspace work;
        report = lights::count_lists(cull::make_row_grid(view), in.lights, {}, work, dense);
        std::vector<std::uint32_t> indices(report.written);
        lights::fill_lists(work, std::span<std::uint32_t>(indices));
        for (std::uint32_t const key : unique) {
            cluster::KeyParts const p = in.layout.parts(key);
            lights::Cell const cell = dense[view.index(p.column, p.row, p.slice)];
            cells.push_back({static_cast<std::uint32_t>(list.size()), cell.count});
            list.insert(list.end(), indices.begin() + cell.offset, indices.begin() + cell.offset + cell.count);
        }
    }
};

inline void check_tree(backend::Backend& device, pipeline::DeviceLists& lists, HostLists const& host) {
    auto const state = lists.sizes().state;
    bvh::Layout const& layout = host.tree.layout;
    CHECK(state.usable == layout.count[0]);
    CHECK(state.levels == layout.levels);
    CHECK((state.item_slots == layout.item_slots && state.node_slots == layout.node_slots));
    CHECK(std::equal(layout.count.begin(), layout.count.end(), state.count));
    CHECK(std::equal(layout.first.begin(), layout.first.end(), state.first));
    CHECK(same_bits(read_back<std::uint32_t>(device, lists.ids.get(), layout.count[0]), host.tree.ids));
    CHECK(same_bits(read_back<float>(device, lists.items.get(), std::size_t{4} * layout.item_slots), host.tree.items));
    CHECK(same_bits(read_back<float>(device, lists.nodes.get(), std::size_t{6} * layout.node_slots), host.tree.nodes));
}

inline void check_bounds(backend::Backend& device, pipeline::DeviceLists& lists, HostLists const& host) {
    auto const places = read_back<std::int32_t>(device, lists.places.get(), 6 * host.bounds.size());
    std::vector<math::Aabb> bounds(host.bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bounds[i].lo[static_cast<math::axis_t>(axis)] = math::from_ordinal(places[6 * i + axis]);
            bounds[i].hi[static_cast<math::axis_t>(axis)] = math::from_ordinal(-places[6 * i + axis + 3]);
        }
    CHECK(same_bits(bounds, host.bounds));
}

/// Makes the lists of a frame on a backend, twice in the same buffers, and compares each step with the host's.
inline void check_device_lists(DeviceFrame const& from, backend::Backend& device, std::int32_t tile_px, std::uint32_t normal_n) {
    pipeline::Frame const& frame = from.frame;
    double deepest = frame.view.near_m + 1.0;
    pipeline::SampleDepth const depth(frame);
    for (math::vec3 const& p : frame.samples.position) deepest = std::max(deepest, static_cast<double>(depth(p)));
    // Samples beyond the last plane are in the last slice.
    auto const grid = cluster::make_grid(frame.view, math::ivec2(tile_px, tile_px), cluster::make_cubical_slices(frame.view, tile_px, deepest).value());
    REQUIRE(grid.has_value());
    auto const layout = pipeline::make_device_layout(grid->view(), normal_n);
    REQUIRE(layout.has_value());
    CHECK(layout->packed == (normal_n < 4));
    pipeline::PreparedLights prepared;
    pipeline::prepare_lights(frame, from.lights, prepared);
    pipeline::Verbs verbs(device);
    pipeline::StagedSamples samples;
    samples.fit(verbs, frame);
    pipeline::DeviceListsInput const in{frame, *grid, *layout, prepared.culled, samples.samples.get(), samples.normals.get()};
    HostLists const host(in);
    pipeline::DeviceLists lists;
    for (int repeat = 0; repeat < 2; ++repeat) {
        REQUIRE(lists.upload(verbs, in).has_value());
        lists.find_keys(verbs, in);
        lists.find_unique(verbs, in);
        lists.find_bounds(verbs, in);
        lists.build_tree(verbs, in);
        lists.count(verbs, in);
        REQUIRE(device.finish().has_value());
        CHECK(lists.sizes().state.clusters == host.unique.size());
        REQUIRE(lists.sizes().pairs == host.list.size());
        lists.fill(verbs, in);
        INFO((verbs.good() ? std::string() : verbs.failure().message));
        REQUIRE(verbs.good());
    }
    CHECK(same_bits(read_back<std::uint32_t>(device, lists.keys.get(), host.keys.size()), host.keys));
    CHECK(same_bits(read_back<std::uint32_t>(device, lists.unique_keys.get(), host.unique.size()), host.unique));
    CHECK(same_bits(read_back<std::uint32_t>(device, lists.index.get(), host.index.size()), host.index));
    check_bounds(device, lists, host);
    check_tree(device, lists, host);
    CHECK(same_bits(read_back<lights::Cell>(device, lists.cells.get(), host.cells.size()), host.cells));
    CHECK(same_bits(read_back<std::uint32_t>(device, lists.ordered.get(), host.list.size()), host.list));
    CHECK(lists.sizes().state.bad == host.report.lights.bad);
    CHECK((lists.sizes().state.masked == 0 && lists.sizes().state.background == 0 && lists.sizes().state.invalid == 0));
}

/// Scans and sorts of several sizes, tiles of tiles of tiles among them, against loops.
inline void check_scan_and_sort(backend::Backend& device, std::span<std::uint32_t const> sizes) {
    pipeline::Verbs verbs(device);
    pipeline::DeviceScan scan;
    std::uint32_t state = 1;
    auto const bits = [&state] { return (state = state * 1664525U + 1013904223U) >> 8U; };
    for (std::uint32_t const size : sizes) {
        std::vector<std::uint32_t> numbers(size), sums(size);
        std::uint64_t sum = 0;
        for (std::uint32_t i = 0; i < size; ++i) {
            numbers[i] = bits() % (size > 100'000 ? 20'000U : 7U);  // large ones go beyond 32 bits
            sums[i] = static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, 0xFFFFFFFFU));
            sum += numbers[i];
        }
        std::vector<std::array<std::uint32_t, 2>> pairs(size);
        for (std::uint32_t i = 0; i < size; ++i) pairs[i] = {bits() * (size % 2 == 0 ? 64U : 0U) >> 1U, i};
        pipeline::StagedBuffer values, from, spare;
        values.fill<std::uint32_t>(verbs, numbers);
        scan.scan(verbs, values.get(), size);
        CHECK(same_bits(read_back<std::uint32_t>(device, values.get(), size), sums));
        from.fill<std::array<std::uint32_t, 2>>(verbs, pairs);
        backend::BufferId const sorted = scan.sort(verbs, from.get(), spare.fit(verbs, std::size_t{size} * 8), {size, 31});
        std::stable_sort(pairs.begin(), pairs.end(), [](auto const& a, auto const& b) { return a[0] < b[0]; });
        CHECK(same_bits(read_back<std::array<std::uint32_t, 2>>(device, sorted, size), pairs));
        REQUIRE(verbs.good());
    }
}

}  // namespace gnomon::test
