#include "parity.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/sample/reconstruct.hpp>
#include <gnomon/vulkan/spirv.hpp>

#include "shaders/parity_reconstruct_comp.hpp"

#include <cstddef>

namespace {

using namespace gnomon;
using vulkan::test::HardFloats;

struct ReconstructItem {
    std::uint32_t camera;
    math::vec2 px;
    sample::Triangle triangle;
};
static_assert(sizeof(ReconstructItem) == 48);

std::vector<sample::RayCamera> reconstruct_cameras() {
    std::vector<sample::RayCamera> cameras;
    for (double const offset : {0.0, 3.0, 1000.0}) {
        math::PerspectiveConfig wide;
        wide.eye_m = math::dvec3(offset, 2.0, -offset);
        wide.target_m = wide.eye_m + math::dvec3(0.7, -0.3, -1.0);
        wide.size_px = math::ivec2(1024, 768);
        cameras.push_back(sample::make_ray_camera(math::make_perspective(wide).value(), math::dvec3(0.0)));
        math::OrthographicConfig flat;
        flat.eye_m = wide.eye_m;
        flat.target_m = wide.target_m;
        flat.window_m = {-12.0, 12.0, -9.0, 9.0};
        flat.far_m = 100.0;
        flat.size_px = math::ivec2(1024, 768);
        cameras.push_back(sample::make_ray_camera(math::make_orthographic(flat).value(), math::dvec3(0.0)));
    }
    return cameras;
}

ReconstructItem reconstruct_item(HardFloats& random, std::vector<sample::RayCamera> const& cameras) {
    ReconstructItem item;
    item.camera = static_cast<std::uint32_t>(random.bits() % cameras.size());
    bool const hard = random.bits() % 8U == 0;
    item.px = hard ? math::vec2{random.any(), random.any()}
                   : math::vec2{random.between(0.0F, 1024.0F), static_cast<float>(random.bits() % 768U) + 0.5F};
    sample::RayCamera const& camera = cameras[item.camera];
    math::vec3 const middle = camera.eye + camera.forward * random.between(0.5F, 40.0F);
    float const size = random.bits() % 4U == 0 ? 0.01F : 3.0F;
    for (math::vec3& p : item.triangle)
        p = hard ? math::vec3{random.any(), random.any(), random.any()}
                 : middle + math::vec3{random.between(-size, size), random.between(-size, size), random.between(-size, size)};
    if (random.bits() % 16U == 0) item.triangle[2] = (item.triangle[0] + item.triangle[1]) * 0.5F;  // hardly any area
    if (random.bits() % 16U == 0) item.triangle[1] = item.triangle[0] + camera.forward;           // edge on
    return item;
}

void reconstruct_host(std::vector<sample::RayCamera> const& cameras, std::span<std::uint32_t const> in,
                      std::span<std::uint32_t> out) {
    ReconstructItem item;
    std::memcpy(&item, in.data(), sizeof item);
    formula::Vec3<float> const a(item.triangle[0]);
    formula::Vec3<float> const b(item.triangle[1]);
    formula::Vec3<float> const c(item.triangle[2]);
    auto const made = gn_reconstruct(cameras[item.camera], formula::Vec2<float>(item.px), a, b, c);
    float const values[] = {made.position.x.v, made.position.y.v, made.position.z.v, made.error.x.v,
                            made.error.y.v,    made.error.z.v,    made.normal.x.v,   made.normal.y.v,
                            made.normal.z.v,   made.normal_error.v};
    std::memcpy(out.data(), values, sizeof values);
    out[10] = made.usable.v ? 1U : 0U;
}

}  // namespace

TEST_CASE("a million reconstructed samples have the same bits on the device", "[vulkan][parity]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::ParityKernel const kernel{"parity_reconstruct", vulkan::test::parity_reconstruct_comp, 12, 11};
    std::vector<sample::RayCamera> const cameras = reconstruct_cameras();
    std::span<std::uint32_t const> const shared[] = {
        {reinterpret_cast<std::uint32_t const*>(cameras.data()), cameras.size() * sizeof(sample::RayCamera) / 4}};
    HardFloats random(6);
    std::vector<vulkan::test::Agreement> total(kernel.out);
    for (int chunk = 0; chunk < 8; ++chunk) {
        std::vector<ReconstructItem> items(125'000);
        for (ReconstructItem& item : items) item = reconstruct_item(random, cameras);
        std::span<std::uint32_t const> const words{reinterpret_cast<std::uint32_t const*>(items.data()), items.size() * 12};
        auto const results = vulkan::test::run_on_device(*device, kernel, words, shared);
        auto const columns = vulkan::test::compare(kernel, words, results, [&](auto in, auto out) {
            reconstruct_host(cameras, in, out);
        });
        for (std::size_t c = 0; c < columns.size(); ++c) {
            total[c].compared += columns[c].compared;
            total[c].differing += columns[c].differing;
            total[c].flushed += columns[c].flushed;
            total[c].worst_ulps = std::max(total[c].worst_ulps, columns[c].worst_ulps);
        }
    }
    for (std::size_t c = 0; c < total.size(); ++c) {
        CAPTURE(c, total[c].compared, total[c].flushed, total[c].worst_ulps);
        CHECK(total[c].differing == 0);
        CHECK(total[c].compared > 900'000);
    }
    CHECK(device->take_messages() == "");
}

TEST_CASE("a camera's rays lie in the shader as in C++", "[vulkan][parity]") {
    using sample::RayCamera;
    std::vector<vulkan::ShaderMember> const expected = {{"eye", offsetof(RayCamera, eye), 12},
                                                        {"perspective", offsetof(RayCamera, perspective), 4},
                                                        {"corner", offsetof(RayCamera, corner), 12},
                                                        {"unused_a", offsetof(RayCamera, unused_a), 4},
                                                        {"dx", offsetof(RayCamera, dx), 12},
                                                        {"unused_b", offsetof(RayCamera, unused_b), 4},
                                                        {"dy", offsetof(RayCamera, dy), 12},
                                                        {"unused_c", offsetof(RayCamera, unused_c), 4},
                                                        {"forward", offsetof(RayCamera, forward), 12},
                                                        {"unused_d", offsetof(RayCamera, unused_d), 4}};
    CHECK(vulkan::members_of(vulkan::test::parity_reconstruct_comp, "GnRayCamera") == expected);
}
