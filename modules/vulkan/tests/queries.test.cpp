#include "pass_rig.hpp"
#include "pass_scenes.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/raster/sample_query.hpp>
#include <gnomon/vulkan/queries.hpp>

#include <cstring>
#include <limits>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

/// Counts that `record` writes into a buffer of `n`.
template <class Record>
std::vector<std::uint32_t> counted(Device& device, PassRig& rig, std::size_t n, Record record) {
    auto const buffer = vulkan::make_buffer(rig.gpu(), n * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT, vulkan::MemoryUse::read_back);
    REQUIRE(buffer);
    REQUIRE(record(device.begin(), vulkan::CountsOut{buffer->handle.get(), 0}));
    device.submit_and_wait();
    REQUIRE(vulkan::invalidate(*rig.gpu(), buffer->allocation.memory(), 0, n * 4));
    std::vector<std::uint32_t> counts(n);
    std::memcpy(counts.data(), buffer->allocation.memory().mapped, n * 4);
    return counts;
}

std::vector<math::Aabb> boxes_at_random(std::uint64_t seed, std::size_t n) {
    Random random{seed};
    std::vector<math::Aabb> boxes;
    for (std::size_t i = 0; i < n; ++i) {
        math::vec3 const middle{random.in(-5, 5), random.in(-5, 5), random.in(-12, 2)};
        math::vec3 const half{random.in(0, 0.6F), random.in(0, 0.6F), random.in(0, 0.6F)};
        boxes.push_back({middle - half, middle + half});
    }
    boxes[3] = math::Aabb{};
    boxes[4].hi.x = std::numeric_limits<float>::quiet_NaN();
    return boxes;
}

raster::Layer cpu_view(Pixels& pixels, backend::PassLayer const& view, math::ivec2 size_px) {
    raster::Layer layer{.target = raster::make_image(pixels.depth.data(), size_px.x, size_px.y)};
    layer.origin = view.origin;
    layer.clip_from_relative = view.clip_from_relative;
    layer.groups = view.groups;
    layer.config.depth = view.depth;
    layer.config.range = view.range;
    return layer;
}

}  // namespace

TEST_CASE("a box counts 0 on the device where it does on the CPU, else as many samples or twice", "[vulkan][queries]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    Soup const soup = make_soup(5, 60, 1.2F);
    backend::Draw const draw = soup.draw();
    math::ivec2 const size_px{160, 120};
    std::vector<math::Aabb> const boxes = boxes_at_random(9, 300);
    vulkan::Features no_clamp = device->features();
    no_clamp.depth_clamp = false;
    for (vulkan::Features const& features : {device->features(), no_clamp})
        for (backend::DepthRange range : {backend::DepthRange::clip, backend::DepthRange::clamp}) {
            PassRig rig(*device, device->gpu_with(features));
            auto queries = vulkan::SampleQueries::make(rig.gpu(), {.capacity = 128});
            REQUIRE(queries);
            vulkan::DrawList list = rig.keep({&draw, 1});
            vulkan::Target target = rig.make({.size_px = size_px, .layers = 1});
            backend::PassLayer view = layer_of(camera(size_px));
            rig.draw(list, target, {&view, 1});
            view.range = range;
            auto const counts = counted(*device, rig, boxes.size(), [&](VkCommandBuffer commands, auto const& out) {
                return queries->record_boxes(commands, boxes, target, view, out);
            });
            Pixels pixels = rig.read(target);
            raster::QueryWorkspace workspace;
            core::SerialExecutor serial;
            std::vector<std::uint64_t> truth(boxes.size());
            raster::count_samples_passing(boxes, cpu_view(pixels, view, size_px), truth, workspace, serial);
            std::size_t seen = 0;
            std::size_t hidden = 0;
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                INFO("box " + std::to_string(i));
                CHECK((counts[i] == 0) == (truth[i] == 0));
                CHECK(counts[i] >= truth[i]);
                CHECK(counts[i] <= 2 * truth[i] + 4);  // Snapping may fold the faces at an edge.
                (truth[i] == 0 ? hidden : seen) += 1;
            }
            CHECK(seen > 50);
            CHECK(hidden > 50);
            CHECK(counts[3] == 0);
            CHECK(counts[4] == 0);
        }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("a draw without overlap counts exactly the CPU's samples; drawing changed nothing", "[vulkan][queries]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    Soup const soup = make_soup(5, 60, 1.2F);
    std::vector<Soup> singles;
    std::vector<backend::Draw> draws;
    for (std::uint64_t i = 0; i < 40; ++i) singles.push_back(make_soup(100 + i, 1, 1.5F));
    for (Soup const& single : singles) draws.push_back(single.draw());
    for (std::size_t i = 0; i < draws.size(); ++i) draws[i].cull = static_cast<backend::Cull>(i % 3);
    draws[7].groups = 2;
    draws[9].indices = {};
    draws[9].positions = {};
    PassRig rig(*device, device->gpu());
    math::ivec2 const size_px{128, 128};
    backend::Draw const scene = soup.draw();
    vulkan::DrawList list = rig.keep({&scene, 1});
    vulkan::DrawList tested = rig.keep(draws);
    vulkan::Target target = rig.make({.size_px = size_px, .layers = 3});
    backend::PassLayer view = layer_of(camera(size_px));
    view.layer = 2;
    view.groups = 1;
    rig.draw(list, target, {&view, 1});
    Pixels const before = rig.read(target);
    auto queries = vulkan::SampleQueries::make(rig.gpu(), {.capacity = 16});
    REQUIRE(queries);
    auto const counts = counted(*device, rig, draws.size(), [&](VkCommandBuffer commands, auto const& out) {
        return queries->record_draws(commands, tested, target, view, out);
    });
    Pixels const after = rig.read(target);
    CHECK(before.depth == after.depth);
    Pixels third;
    third.depth.assign(after.depth.begin() + 2 * 128 * 128, after.depth.end());
    raster::QueryWorkspace workspace;
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        backend::Draw const& draw = draws[i];
        bool const taken = (draw.groups & view.groups) != 0;
        std::uint64_t const truth =
            taken ? raster::count_samples_passing({&draw, 1}, cpu_view(third, view, size_px), workspace) : 0;
        INFO("draw " + std::to_string(i));
        CHECK(counts[i] == truth);
        sum += truth;
    }
    CHECK(sum > 1000);
    CHECK(device->take_messages() == "");
}

TEST_CASE("a device without precise queries is told so", "[vulkan][queries]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    auto const refused = vulkan::SampleQueries::make(device->gpu_with({}));
    REQUIRE(!refused);
    CHECK(refused.failure().code == vulkan::Error::missing_feature);
    CHECK(refused.failure().message.find("occlusionQueryPrecise") != std::string::npos);
}
