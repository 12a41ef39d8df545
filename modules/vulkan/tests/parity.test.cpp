#include "parity.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/math/morton.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/projection/cube.hpp>
#include <gnomon/shadow/filter.hpp>

#include "shaders/parity_approximate_comp.hpp"
#include "shaders/parity_scalar_comp.hpp"

#include <cmath>

namespace {

using namespace gnomon;
using vulkan::test::Agreement;
using vulkan::test::HardFloats;
using vulkan::test::ParityKernel;

constexpr std::size_t parity_items = 1'000'000;
constexpr std::size_t parity_chunk = 125'000;

std::uint32_t word(float x) { return std::bit_cast<std::uint32_t>(x); }
float real(std::uint32_t x) { return std::bit_cast<float>(x); }
std::uint32_t flag(bool b, unsigned place) { return b ? 1U << place : 0U; }

void scalar_host(std::span<std::uint32_t const> in, std::span<std::uint32_t> out) {
    using F = formula::Float<float>;
    float const a = real(in[0]);
    float const b = real(in[1]);
    float const c = real(in[2]);
    int const taps = 1 + static_cast<int>(in[3] % 15U);
    auto const code = static_cast<std::uint16_t>(in[3] & 0xFFFFU);
    shadow::TapRow const row = shadow::taps_at(a, taps);
    std::uint32_t const results[] = {
        static_cast<std::uint32_t>(projection::face_of(math::vec3(a, b, c))),
        static_cast<std::uint32_t>(math::ordinal(a)),
        word(math::from_ordinal(math::ordinal(b))),
        math::morton_30(in[0], in[1], in[2]),
        math::code_of_depth(gn_to_unit(F(a)).v),
        word(math::depth_of_code(code)),
        word(math::depth_of_code(code)),
        static_cast<std::uint32_t>(row.first),
        word(row.fraction),
        word(row.weight(0)),
        word(row.weight(taps - 1)),
        flag(b < c, 0) | flag(b <= c, 1) | flag(b == c, 2) | flag(b != c, 3),
        word(b < a ? b : a),
        word(b > a ? b : a),
        word(a / b),
        word(std::sqrt(std::abs(a))),
        word(a + b / c),
        word((c - b) / a)};
    std::copy(std::begin(results), std::end(results), out.begin());
}

constexpr char const* scalar_names[] = {"face_of", "ordinal", "from_ordinal", "morton_30", "code_of_depth",
                                        "depth_of_code", "depth_of_unorm16", "taps_at.first", "taps_at.fraction",
                                        "first weight", "last weight", "compare", "min", "max", "div", "sqrt",
                                        "depth_from_distance", "distance_from_depth"};

/// The columns of one chunk added to those of all.
void add_up(std::vector<Agreement>& total, std::vector<Agreement> const& more) {
    if (total.empty()) total.resize(more.size());
    for (std::size_t c = 0; c < more.size(); ++c) {
        if (total[c].differing == 0) total[c].first = more[c].first;
        total[c].compared += more[c].compared;
        total[c].differing += more[c].differing;
        total[c].flushed += more[c].flushed;
        total[c].worst_ulps = std::max(total[c].worst_ulps, more[c].worst_ulps);
    }
}

}  // namespace

TEST_CASE("formulas of scalars have the same bits on the device, 1e6 hard inputs each", "[vulkan][parity]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    ParityKernel const kernel{"parity_scalar", vulkan::test::parity_scalar_comp, 4, 18};
    HardFloats random(1);
    std::vector<Agreement> total;
    std::vector<std::uint32_t> inputs(parity_chunk * kernel.in);
    for (std::size_t done = 0; done < parity_items; done += parity_chunk) {
        for (std::size_t i = 0; i < inputs.size(); i += 4) {
            float const a = random.any();
            bool const tie = random.bits() % 4U == 0;  // components that are equal, or nearly
            float const b = tie ? random.beside(random.bits() % 2U == 0 ? a : -a) : random.any();
            float const c = tie ? random.beside(random.bits() % 2U == 0 ? b : a) : random.any();
            inputs[i] = word(a);
            inputs[i + 1] = word(b);
            inputs[i + 2] = word(c);
            inputs[i + 3] = random.bits();
        }
        auto const results = vulkan::test::run_on_device(*device, kernel, inputs);
        add_up(total, vulkan::test::compare(kernel, inputs, results, scalar_host));
    }
    for (std::size_t c = 0; c < total.size(); ++c) {
        CAPTURE(scalar_names[c], total[c].compared, total[c].flushed, total[c].worst_ulps, total[c].first);
        CHECK(total[c].differing == 0);
        CHECK(total[c].compared > parity_items * 3 / 4);
    }
    CHECK(device->take_messages() == "");
}

TEST_CASE("the device's own division and root are as near as their exact forms need", "[vulkan][parity]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    ParityKernel const kernel{"parity_approximate", vulkan::test::parity_approximate_comp, 2, 2};
    HardFloats random(2);
    std::vector<std::uint32_t> inputs(parity_chunk * kernel.in);
    for (std::size_t i = 0; i < inputs.size(); i += 2) {
        inputs[i] = 0x3F80'0000U | (random.bits() & 0xFF'FFFFU);      // [1, 4)
        inputs[i + 1] = 0x3F80'0000U | (random.bits() & 0x7F'FFFFU);  // [1, 2)
    }
    auto const results = vulkan::test::run_on_device(*device, kernel, inputs);
    auto const columns = vulkan::test::compare(kernel, inputs, results, [](auto in, auto out) {
        out[0] = word(real(in[0]) / real(in[1]));
        out[1] = word(std::sqrt(real(in[0])));
    });
    CAPTURE(columns[0].worst_ulps, columns[1].worst_ulps);
    CHECK(columns[0].worst_ulps <= 5);
    CHECK(columns[1].worst_ulps <= 8);
}

TEST_CASE("a wrong result is found by the comparison", "[vulkan][parity]") {
    ParityKernel const kernel{"none", {}, 1, 1};
    std::uint32_t const inputs[] = {word(1.0F), word(2.0F), 1U};
    std::uint32_t const device[] = {word(2.0F), word(4.0F) + 3, 0U};
    auto const columns = vulkan::test::compare(kernel, inputs, device, [](auto in, auto out) {
        out[0] = word(real(in[0]) + real(in[0]));  // of the smallest subnormal: zero, where it is flushed
    });
#if defined(__SSE2__)
    CHECK(columns[0].flushed == 1);
    CHECK(columns[0].differing == 1);
#endif
    CHECK(columns[0].first == 1);
    CHECK(columns[0].worst_ulps == 3);
    CHECK(vulkan::test::steps_between(word(-0.0F), word(0.0F)) == 0);
    CHECK(vulkan::test::steps_between(word(std::numeric_limits<float>::quiet_NaN()), word(1.0F)) > 0xFFFF'FFFFU);
}
