#include <gnomon/check/check.hpp>
#include <gnomon/cluster/key.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;
using cluster::KeyParts;

/// A grid view with so many columns, rows and slices.
struct BareGrid {
    std::vector<float> x, y, depth_m;

    BareGrid(std::uint32_t columns, std::uint32_t rows, std::uint32_t slices) {
        for (std::uint32_t i = 0; i <= columns; ++i) x.push_back(static_cast<float>(i));
        for (std::uint32_t i = 0; i <= rows; ++i) y.push_back(static_cast<float>(i));
        for (std::uint32_t i = 0; i <= slices; ++i) depth_m.push_back(static_cast<float>(i + 1));
    }
    [[nodiscard]] cluster::GridView view() const { return {x, y, depth_m, true}; }
};

template <cluster::Key K>
void check_round_trip(KeyParts const& p) {
    CHECK(cluster::unpack_key(cluster::pack_key<K>(p)) == p);
}

}  // namespace

TEST_CASE("a packed key holds the paper's fields, in the formula's bits, and gives them back", "[cluster][property]") {
    CHECK(cluster::pack_key<std::uint32_t>({1, 2, 3, 4}) == 0x020100C4U);
    CHECK(cluster::pack_key<std::uint64_t>({1, 2, 3, 4}) == 0x0002'0001'0003'0004ULL);
    using Uint = formula::Uint<float>;
    check::for_all(check::integers(0U, 255U), check::integers(0U, 255U), check::integers(0U, 1023U), check::integers(0U, 63U),
                   [](std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t m) {
                       KeyParts const p{i, j, k, m};
                       check_round_trip<std::uint32_t>(p);
                       std::uint32_t const key = cluster::pack_key<std::uint32_t>(p);
                       CHECK(gn_pack_key(Uint(i), Uint(j), Uint(k), Uint(m)).v == key);
                       KeyParts const read{gn_key_column(Uint(key)).v, gn_key_row(Uint(key)).v, gn_key_slice(Uint(key)).v, gn_key_cell(Uint(key)).v};
                       CHECK(read == p);
                   });
    auto const wide = check::integers(0U, 65535U);
    check::for_all(wide, wide, wide, wide, [](std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t m) {
        KeyParts const p{i, j, k, m};
        check_round_trip<std::uint64_t>(p);
        std::uint64_t const tile = gn_wide_key_tile(Uint(i), Uint(j)).v;
        CHECK(cluster::pack_key<std::uint64_t>(p) == (tile << 32U | gn_wide_key_inner(Uint(k), Uint(m)).v));
    });
}

TEST_CASE("numbers of keys are dense and ascend with the keys", "[cluster]") {
    BareGrid const bare(3, 4, 5);
    auto const layout = cluster::make_key_layout<std::uint32_t>(bare.view(), 2).value();
    REQUIRE(layout.domain() == 3 * 4 * 5 * 24);
    for (std::uint64_t n = 0; n < layout.domain(); ++n) {
        KeyParts const p = cluster::unpack_key(layout.key(n));
        CHECK(layout.holds(p));
        CHECK(layout.number(p) == n);
        if (n != 0) CHECK(layout.key(n - 1) < layout.key(n));
    }
    CHECK_FALSE(layout.holds(cluster::unpack_key(cluster::no_key<std::uint32_t>)));
    CHECK_FALSE(layout.holds({3, 0, 0, 0}));
    CHECK_FALSE(layout.holds({0, 4, 0, 0}));
    CHECK_FALSE(layout.holds({0, 0, 5, 0}));
    CHECK_FALSE(layout.holds({0, 0, 0, 24}));
}

TEST_CASE("what fits no key is refused when it is configured, with the number", "[cluster]") {
    using enum cluster::KeyError;
    auto const narrow = [](std::uint32_t c, std::uint32_t r, std::uint32_t s, std::uint32_t n) {
        BareGrid const bare(c, r, s);
        return cluster::make_key_layout<std::uint32_t>(bare.view(), n);
    };
    auto const largest = narrow(256, 256, 1024, 3);
    REQUIRE(largest.has_value());
    CHECK(largest->key(largest->domain() - 1) != cluster::no_key<std::uint32_t>);
    CHECK(narrow(257, 1, 1, 0).failure().code == too_many_tiles);
    CHECK(narrow(1, 257, 1, 0).failure().code == too_many_tiles);
    CHECK(narrow(1, 1, 1025, 0).failure().code == too_many_slices);
    CHECK(narrow(1, 1, 1, 4).failure().code == too_many_normals);
    CHECK(narrow(300, 1, 1, 0).failure().message == "300 tiles a side: at most 256 in a key of 32 bits");
    BareGrid const wide(65536, 2, 65536);
    auto const most = cluster::make_key_layout<std::uint64_t>(wide.view(), 104);
    REQUIRE(most.has_value());
    CHECK(most->key(most->domain() - 1) != cluster::no_key<std::uint64_t>);
    CHECK(cluster::make_key_layout<std::uint64_t>(wide.view(), 105).failure().code == too_many_normals);
    BareGrid const wider(65537, 2, 1);
    CHECK(cluster::make_key_layout<std::uint64_t>(wider.view()).failure().code == too_many_tiles);
}

TEST_CASE("the key of a sample is its pixel's tile, its depth's slice and its normal's cell", "[cluster]") {
    math::PerspectiveConfig config;
    config.size_px = {200, 100};
    config.far_m = 50.0;
    auto const view = math::make_perspective(config).value();
    auto const grid = cluster::make_grid(view, math::ivec2(32, 32), cluster::make_cubical_slices(view, 32, 50.0).value()).value();
    auto const layout = cluster::make_key_layout<std::uint32_t>(grid.view(), 3).value();
    math::vec3 const up(0.0F, 1.0F, 0.0F);
    auto const p = cluster::unpack_key(key_at(grid, layout, math::uvec2(199, 64), 3.0F, up));
    CHECK(p == KeyParts{6, 2, slice_at(grid.slices(), 3.0F), 2 * 9 + 4});
    auto const flat = cluster::make_key_layout<std::uint32_t>(grid.view()).value();
    CHECK(cluster::unpack_key(key_at(grid, flat, math::uvec2(0, 0), 0.0F, up)) == KeyParts{0, 0, 0, 0});
}
