#include "parity.hpp"

#include <gnomon/bvh/formula/code.glsl>
#include <gnomon/check/check.hpp>
#include <gnomon/cull/normal_cone.hpp>
#include <gnomon/cull/shapes.hpp>

#include "shaders/parity_cull_comp.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace {

using namespace gnomon;
using vulkan::test::HardFloats;

constexpr std::size_t cull_in = 45;
constexpr std::size_t cull_out = 32;
using CullItem = std::array<float, cull_in>;

math::vec3 cull_direction(HardFloats& random) {
    float const x = random.between(-1.0F, 1.0F);
    float const y = random.between(-1.0F, 1.0F);
    float const z = random.between(-1.0F, 1.0F);
    return math::to_float(glm::normalize(math::dvec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z) + 1e-6)));
}

void cull_put(CullItem& item, std::size_t at, math::vec3 const& v) {
    item[at] = v.x;
    item[at + 1] = v.y;
    item[at + 2] = v.z;
}

/// A light, a cluster and a box near each other, a plane through them; one in sixteen of hard numbers.
CullItem cull_item(HardFloats& random) {
    CullItem item{};
    float const scale = random.bits() % 8U == 0 ? 1e5F : 10.0F;
    math::vec3 const light(random.between(-scale, scale), random.between(-scale, scale), random.between(-0.2F * scale, 2.0F * scale));
    cull_put(item, 0, light);
    item[3] = random.between(0.0F, scale * 0.5F);
    cull_put(item, 4, cull_direction(random));
    math::detail::CosSin const angle = math::detail::cos_sin(static_cast<double>(random.between(0.0F, 3.14F)));
    item[7] = static_cast<float>(angle.cosine);
    item[8] = static_cast<float>(angle.sine);
    item[9] = random.between(-1.0F, 1.0F);
    item[10] = item[9] + random.between(0.01F, 0.3F);
    item[11] = random.between(-1.0F, 1.0F);
    item[12] = item[11] + random.between(0.01F, 0.3F);
    item[13] = random.between(0.1F, 1.0F) * scale;
    item[14] = item[13] * random.between(1.1F, 2.0F);
    math::vec3 const lo = light + cull_direction(random) * (item[3] * random.between(0.0F, 1.5F));
    cull_put(item, 15, lo);
    cull_put(item, 18, lo + math::vec3(random.between(0.0F, 3.0F), random.between(0.0F, 3.0F), random.between(0.0F, 3.0F)));
    for (std::size_t k = 0; k < 3; ++k) cull_put(item, 21 + 3 * k, cull_direction(random) * random.between(0.0F, scale * 0.3F));
    cull_put(item, 30, cull_direction(random));
    float const c = random.between(-0.2F, 1.0F);
    item[33] = c;
    item[34] = std::sqrt(1.0F - c * c);
    math::vec3 const n = cull_direction(random);
    item[43] = random.between(0.0F, scale * 0.2F);
    double const through = glm::dot(math::to_double(n), math::to_double(light));
    formula::GnPlane const plane = math::formula_plane({math::to_double(n), -through + static_cast<double>(item[3]) * (random.bits() % 2U != 0 ? 1.0 : -1.0)});
    cull_put(item, 35, plane.normal);
    item[38] = plane.offset;
    cull_put(item, 39, plane.magnitude);
    item[42] = plane.norm;
    if (random.bits() % 16U == 0)
        for (int k = 0; k < 3; ++k) item[random.bits() % cull_in] = random.any();
    return item;
}

void cull_host(std::span<std::uint32_t const> in, std::span<std::uint32_t> out) {
    CullItem f;
    std::memcpy(f.data(), in.data(), sizeof f);
    using Vec = formula::Vec3<float>;
    auto const at = [&f](std::size_t k) { return Vec(f[k], f[k + 1], f[k + 2]); };
    formula::GnSphere<float> const ball{at(0), f[3]};
    formula::GnSector<float> const cone{at(0), f[3], at(4), f[7], f[8]};
    formula::GnCell<float> const cell{f[9], f[10], f[11], f[12], f[13], f[14]};
    formula::GnBox<float> const box{at(15), at(18)};
    formula::GnCrate<float> const crate{at(0), at(21), at(24), at(27)};
    formula::GnNormalCone<float> const normals{at(30), f[33], f[34]};
    formula::GnPlane const plane{math::vec3(f[35], f[36], f[37]), f[38], math::vec3(f[39], f[40], f[41]), f[42]};
    formula::GnSphere<float> const other{at(18), f[43]};
    bool const flags[16] = {gn_touches_sphere_cell(ball, cell, true).v, gn_touches_sphere_cell(ball, cell, false).v,
                            gn_touches_sector_cell(cone, cell, true, 2).v, gn_touches_sector_cell(cone, cell, false, 2).v,
                            gn_touches_crate_cell(crate, cell, true).v, gn_touches_box_cell(box, cell, true).v,
                            gn_touches_sphere_box(ball.center, gn_touch_limit(ball.radius), box).v,
                            gn_touches_sphere_sphere(ball.center, ball.radius, other).v, gn_touches_plane_box(plane, box).v,
                            gn_touches_plane_sphere(plane, ball).v, gn_touches_plane_sector(plane, cone).v,
                            gn_touches_plane_crate(plane, crate).v, gn_touches_sector_box(cone, box).v,
                            gn_touches_sector_sphere(cone, other).v, gn_touches_crate_box(crate, box).v,
                            gn_may_face(normals, other, ball.center).v};
    for (std::size_t k = 0; k < 16; ++k) out[k] = flags[k] ? 1U : 0U;
    auto const around = gn_box_of(ball);
    Vec const near_cell = gn_nearest_of_cell(cell, ball.center, true);
    Vec const near_cone = gn_nearest_of_sector(cone, other.center);
    Vec const direction = gn_direction(ball.center - other.center);
    Vec const near_crate = gn_nearest_of_crate(crate, other.center);
    float const values[15] = {around.lo.x.v, around.hi.y.v, gn_reach_of_sector(cone, normals.axis).value.v,
                              near_cell.x.v, near_cell.y.v, near_cell.z.v, near_cone.x.v, near_cone.y.v, near_cone.z.v,
                              direction.x.v, direction.y.v, gn_reach_of_cell(cell, direction, true).value.v,
                              near_crate.x.v, near_crate.y.v, near_crate.z.v};
    std::memcpy(out.data() + 16, values, sizeof values);
    math::vec3 const scale(formula::gn_code_scale(-50.0F, 50.0F, 1024.0F), formula::gn_code_scale(-5.0F, f[43], 1024.0F),
                           formula::gn_code_scale(1.0F, 1.0F, 1024.0F));
    out[31] = gn_code_30(formula::GnCodeGrid{math::vec3(-50.0F, -5.0F, 1.0F), 1023.0F, scale, 0U}, ball.center).v;
}

}  // namespace

TEST_CASE("tests of shapes against boxes, planes and clusters have the same bits on the device", "[vulkan][parity]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::ParityKernel const kernel{"parity_cull", vulkan::test::parity_cull_comp, cull_in, cull_out};
    HardFloats random(11);
    std::vector<vulkan::test::Agreement> total(cull_out);
    std::array<std::uint64_t, 16> yes{};
    std::size_t items_tried = 0;
    for (int chunk = 0; chunk < 4; ++chunk) {
        std::vector<CullItem> items(50'000);
        for (CullItem& item : items) item = cull_item(random);
        items_tried += items.size();
        std::span<std::uint32_t const> const words{reinterpret_cast<std::uint32_t const*>(items.data()), items.size() * cull_in};
        auto const results = vulkan::test::run_on_device(*device, kernel, words);
        auto const columns = vulkan::test::compare(kernel, words, results, cull_host);
        for (std::size_t c = 0; c < cull_out; ++c) {
            total[c].compared += columns[c].compared;
            total[c].differing += columns[c].differing;
            total[c].flushed += columns[c].flushed;
        }
        for (std::size_t i = 0; i < items.size(); ++i)
            for (std::size_t k = 0; k < 16; ++k) yes[k] += results[i * cull_out + k];
    }
    for (std::size_t c = 0; c < cull_out; ++c) {
        CAPTURE(c, total[c].compared, total[c].flushed, c < 16 ? yes[c] : 0);
        CHECK(total[c].differing == 0);
        CHECK(total[c].compared > items_tried * 95 / 100);
        if (c < 16) CHECK((yes[c] > items_tried / 1000 && yes[c] < items_tried * 999 / 1000));
    }
    CHECK(device->take_messages() == "");
}
