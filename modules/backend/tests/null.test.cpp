#include <gnomon/backend.hpp>
#include <gnomon/check/check.hpp>

#include <array>
#include <string>
#include <vector>

namespace {

using namespace gnomon;
using backend::Error;

struct Rig {
    backend::NullBackend device;
    std::array<math::vec3, 6> corners{};
    backend::DrawListId list;
    backend::TargetId target;
    backend::BufferId buffer;

    Rig() {
        backend::Draw one{.positions = std::span<math::vec3 const>(corners), .indices = {}};
        one.groups = 1;
        backend::Draw two = one;
        two.groups = 2;
        std::array const draws{one, two};
        list = *device.keep(draws);
        target = *device.make_target({.size_px = math::ivec2(64, 32), .layers = 2});
        buffer = *device.make_buffer(100);
    }
};

template <class T>
bool refuses(backend::Result<T> const& result, Error code, std::string_view word) {
    return !result && result.failure().code == code && result.failure().message.find(word) != std::string::npos;
}

void nothing(backend::KernelData const&, std::size_t, std::size_t) {}

constexpr backend::Kernel two_buffers{.name = "two", .cpu = &nothing, .spirv = {}, .buffers = 2, .constant_bytes = 8};

}  // namespace

TEST_CASE("a pass counts the triangles of the draws that share a group with each layer", "[backend][null]") {
    Rig rig;
    std::array<backend::PassLayer, 2> layers;
    layers[0].groups = 1;
    layers[1].groups = 3;
    layers[1].layer = 1;
    CHECK(rig.device.draw(rig.list, rig.target, layers)->triangles == 6);
    CHECK(rig.device.draw(rig.list, rig.target, {})->triangles == 0);
}

TEST_CASE("an id that was released is unknown, and never given again", "[backend][null]") {
    Rig rig;
    backend::BufferId const old = rig.buffer;
    REQUIRE(rig.device.release(rig.buffer));
    CHECK(refuses(rig.device.release(old), Error::bad_argument, "buffer"));
    for (int i = 0; i < 10'000; ++i) {
        backend::BufferId const next = *rig.device.make_buffer(4);
        CHECK(next != old);
        REQUIRE(rig.device.release(next));
    }
    CHECK(rig.device.live() == 2);
    CHECK(refuses(rig.device.release(backend::TargetId::none()), Error::bad_argument, "none"));
    CHECK(refuses(rig.device.draw(backend::DrawListId(7), rig.target, {}), Error::bad_argument, "draw list 7"));
}

TEST_CASE("what does not fit its resource is refused with its value", "[backend][null]") {
    Rig rig;
    std::array<std::byte, 64> bytes{};
    CHECK(rig.device.write(rig.buffer, 36, bytes));
    CHECK(refuses(rig.device.write(rig.buffer, 37, bytes), Error::bad_argument, "from byte 37"));
    CHECK(refuses(rig.device.read(rig.buffer, ~std::size_t{0}, bytes), Error::bad_argument, "64 bytes"));
    backend::PassLayer view;
    view.layer = 2;
    CHECK(refuses(rig.device.draw(rig.list, rig.target, {&view, 1}), Error::bad_argument, "layer 2"));
    std::array<math::Aabb, 26> const boxes{};
    view.layer = 1;
    CHECK(rig.device.count_samples(std::span(boxes).first(25), rig.target, view, rig.buffer, 0));
    CHECK(refuses(rig.device.count_samples(boxes, rig.target, view, rig.buffer, 0), Error::bad_argument, "26"));
    view.subpixel = math::ivec2(0, 128);
    CHECK(refuses(rig.device.draw(rig.list, rig.target, {&view, 1}), Error::bad_argument, "subpixels"));
    view.subpixel = math::ivec2(-127, 127);
    CHECK(rig.device.draw(rig.list, rig.target, {&view, 1}));
    view.viewport = backend::Rect{0, 0, 20'000, 10};
    CHECK(refuses(rig.device.draw(rig.list, rig.target, {&view, 1}), Error::too_large, "20000"));
    CHECK(refuses(rig.device.make_target({.size_px = math::ivec2(20'000, 1)}), Error::too_large, "20000"));
    CHECK(refuses(rig.device.make_target({.size_px = math::ivec2(0, 1)}), Error::bad_argument, "0 x 1"));
    CHECK(refuses(rig.device.make_target({.size_px = math::ivec2(16'384, 16'384), .layers = 6}), Error::too_large,
                  "MiB"));
    CHECK(refuses(rig.device.make_buffer(0), Error::bad_argument, "0 bytes"));
}

TEST_CASE("areas of one pass may not overlap; scissors keep them apart", "[backend][null]") {
    Rig rig;
    std::array<backend::PassLayer, 2> layers;
    layers[0].viewport = backend::Rect{0, 0, 33, 32};
    layers[1].viewport = backend::Rect{32, 0, 32, 32};
    CHECK(refuses(rig.device.draw(rig.list, rig.target, layers), Error::bad_argument, "overlap"));
    layers[0].scissor = backend::Rect{0, 0, 32, 32};
    CHECK(rig.device.draw(rig.list, rig.target, layers));
    layers[0].scissor = {};
    layers[1].layer = 1;
    CHECK(rig.device.draw(rig.list, rig.target, layers));
}

TEST_CASE("a kernel's call fits the kernel, or says what does not", "[backend][null]") {
    Rig rig;
    std::array const buffers{rig.buffer, rig.buffer};
    std::array<std::byte, 8> const constants{};
    CHECK(rig.device.run(two_buffers, {10, buffers, {}, constants}));
    CHECK(refuses(rig.device.run(two_buffers, {10, std::span(buffers).first(1), {}, constants}), Error::bad_argument,
                  "'two' has 2 buffers"));
    CHECK(refuses(rig.device.run(two_buffers, {10, buffers, {}, {}}), Error::bad_argument, "8 bytes"));
    std::array const unknown{rig.buffer, backend::BufferId(9)};
    CHECK(refuses(rig.device.run(two_buffers, {10, unknown, {}, constants}), Error::bad_argument, "buffer 9"));
}

TEST_CASE("a pass of fragments needs colours, what its kernel says, and no alpha tests unless it comes second", "[backend][null]") {
    constexpr auto no_color = [](backend::KernelData const&, std::span<backend::Fragment const>, std::span<backend::FragmentColor>) {};
    static constexpr backend::FragmentKernel plain{.name = "plain", .cpu = no_color, .spirv = {}};
    static constexpr backend::FragmentKernel reads{.name = "reads", .cpu = no_color, .spirv = {}, .targets = 1, .constant_bytes = 8};
    Rig rig;
    auto const target = *rig.device.make_target({.size_px = math::ivec2(64, 32), .triangle_ids = true, .color = true});
    backend::PassLayer layer;
    CHECK(rig.device.shade(rig.list, target, layer, plain, {})->triangles == 4);
    CHECK(refuses(rig.device.shade(rig.list, rig.target, layer, plain, {}), Error::bad_argument, "no colours"));
    CHECK(refuses(rig.device.shade(rig.list, target, layer, reads, {}), Error::bad_argument, "'reads' has 1 targets"));
    backend::TargetBinding own{target, backend::Plane::triangle};
    std::array<std::byte, 8> const constants{};
    CHECK(rig.device.shade(rig.list, target, layer, reads, {.targets = {&own, 1}, .constants = constants}));
    own.plane = backend::Plane::color;
    CHECK(refuses(rig.device.shade(rig.list, target, layer, reads, {.targets = {&own, 1}, .constants = constants}),
                  Error::bad_argument, "tests or writes"));
    layer.range = backend::DepthRange::clamp;
    CHECK(refuses(rig.device.shade(rig.list, target, layer, plain, {}), Error::bad_argument, "clipped"));
    layer.range = backend::DepthRange::clip;
    backend::AlphaTest const holes{};
    backend::Draw leaf{.positions = std::span<math::vec3 const>(rig.corners), .indices = {}};
    leaf.alpha_test = &holes;
    auto const leaves = *rig.device.keep({&leaf, 1});
    CHECK(refuses(rig.device.shade(leaves, target, layer, plain, {}), Error::bad_argument, "alpha tests"));
    CHECK(rig.device.shade(leaves, target, layer, plain, {.test = backend::FragmentTest::visible}));
    CHECK(refuses(rig.device.make_target({.size_px = math::ivec2(4, 4), .depth = backend::DepthFormat::unorm16, .color = true}),
                  Error::unsupported_format, "f32"));
}

TEST_CASE("a part of a target is copied between layers and read whole", "[backend][null]") {
    Rig rig;
    backend::TargetPart part{rig.target, 0, backend::Plane::depth, {0, 0, 8, 4}};
    std::vector<float> out(32, 1.0F);
    REQUIRE(rig.device.read(part, std::as_writable_bytes(std::span(out))));
    REQUIRE(rig.device.finish());
    CHECK(out == std::vector<float>(32, 0.0F));
    CHECK(refuses(rig.device.read(part, std::as_writable_bytes(std::span(out).first(31))), Error::bad_argument, "124"));
    CHECK(rig.device.copy(part, rig.target, 1, math::ivec2(56, 28)));
    CHECK(refuses(rig.device.copy(part, rig.target, 1, math::ivec2(57, 28)), Error::bad_argument, "within"));
    CHECK(refuses(rig.device.copy(part, rig.target, 0, math::ivec2(8, 8)), Error::bad_argument, "itself"));
    part.plane = backend::Plane::triangle;
    CHECK(refuses(rig.device.copy(part, rig.target, 1, math::ivec2(0, 0)), Error::bad_argument, "ids"));
}

TEST_CASE("stages come back once, in order", "[backend][null]") {
    Rig rig;
    rig.device.stage("one");
    rig.device.stage("");
    rig.device.stage("two");
    auto const times = rig.device.finish();
    REQUIRE(times->size() == 2);
    CHECK((*times)[0].name == "one");
    CHECK((*times)[1].name == "two");
    CHECK(rig.device.finish()->empty());
}
