#include <gnomon/cascade/toroidal.hpp>
#include <gnomon/check/check.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace {

namespace torus {

using namespace gnomon;
using namespace gnomon::check;
using cascade::MapTexels;
using cascade::Place;
using cascade::TexelRect;
using cascade::ToroidalPieces;
using cascade::Volume;

auto places() {
    return [](Choices& choices) {
        Place at;
        std::int64_t const far = element_of({0LL, 1LL << 40, -(1LL << 40)})(choices);
        at.x = far + integers(-40, 40)(choices);
        at.y = -far + integers(-40, 40)(choices);
        return at;
    };
}

TEST_CASE("the pieces of a rectangle are its texels, each once, where the torus keeps them", "[toroidal]") {
    for_all(cases(1500), integers(1, 17), places(), array_of<4>(integers(0, 16)),
            [](int size, Place const& at, std::array<int, 4> const& n) {
                Volume const v{at, size, cascade::unorm16_codes, 1.0, 1.0};
                TexelRect rect{n[0] % size, n[1] % size, 0, 0};
                rect.width = n[2] % (size - rect.x + 1);
                rect.height = n[3] % (size - rect.y + 1);
                ToroidalPieces pieces;
                cascade::add_pieces(v, rect, pieces);
                CHECK(pieces.count <= 4);
                std::vector<int> hits(static_cast<std::size_t>(size * size));
                int wrong = 0;
                for (int i = 0; i < pieces.count; ++i) {
                    auto const& [in_map, kept] = pieces.pieces[static_cast<std::size_t>(i)];
                    for (int y = 0; y < in_map.height; ++y)
                        for (int x = 0; x < in_map.width; ++x) {
                            std::int32_t const kept_x = cascade::wrapped(at.x + in_map.x + x, size);
                            std::int32_t const kept_y = cascade::wrapped(at.y + in_map.y + y, size);
                            wrong += kept_x == kept.x + x && kept_y == kept.y + y ? 0 : 1;
                            wrong += formula::gn_toroidal(formula::Int<float>(in_map.x + x),
                                                          cascade::wrapped(at.x, size), size)
                                                 .v == kept_x
                                         ? 0
                                         : 1;
                            ++hits[static_cast<std::size_t>((in_map.y + y) * size + in_map.x + x)];
                        }
                }
                for (int y = 0; y < size; ++y)
                    for (int x = 0; x < size; ++x) {
                        bool const in =
                            x >= rect.x && x < rect.x + rect.width && y >= rect.y && y < rect.y + rect.height;
                        wrong += hits[static_cast<std::size_t>(y * size + x)] == (in ? 1 : 0) ? 0 : 1;
                    }
                CHECK(wrong == 0);
            });
}

TEST_CASE("a toroidal map shows what a scrolled one shows, over walks with jumps", "[toroidal]") {
    for_all(cases(150), integers(3, 17), integers(0, 1 << 20), booleans(), [](int size, int seed, bool reversed) {
        math::Depth const depth = reversed ? math::Depth::reversed : math::Depth::forward;
        auto const cells = static_cast<std::size_t>(size * size);
        std::vector<std::uint16_t> plain(cells);
        std::vector<std::uint16_t> kept(cells);
        Volume v{{-5, 1000000000000LL, 0}, size, 300, 1.0, 1.0};
        std::uint64_t state = static_cast<std::uint64_t>(seed) + 1;
        auto const next = [&](int most) {
            state = state * 6364136223846793005U + 1442695040888963407U;
            return static_cast<int>((state >> 33U) % static_cast<std::uint64_t>(most));
        };
        auto const kept_index = [&](int x, int y) {
            return static_cast<std::size_t>(cascade::wrapped(v.at.y + y, size) * size +
                                            cascade::wrapped(v.at.x + x, size));
        };
        for (int frame = 0; frame < 12; ++frame) {
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    if (frame != 0 && next(3) != 0) continue;
                    auto const value = static_cast<std::uint16_t>(next(301));
                    plain[static_cast<std::size_t>(y * size + x)] = value;
                    kept[kept_index(x, y)] = value;
                }
            Place shift{next(2 * size + 5) - size - 2, next(5) - 2, next(3) == 0 ? next(41) - 20 : 0};
            if (next(4) == 0) shift.x = next(2) == 0 ? size : -size;
            v.at = {v.at.x + shift.x, v.at.y + shift.y, v.at.z + shift.z};
            cascade::MapScroll const by{shift, v.codes, depth};
            cascade::scroll_in_place<std::uint16_t>({plain.data(), size, size}, by);
            std::int64_t const written = cascade::scroll_toroidal<std::uint16_t>({kept.data(), size, size}, v, by);
            std::int64_t open = 0;
            auto const exposed = cascade::exposed_by(shift, size);
            for (int i = 0; i < exposed.count; ++i)
                open += std::int64_t{exposed.rects[static_cast<std::size_t>(i)].width} *
                        exposed.rects[static_cast<std::size_t>(i)].height;
            CHECK(written == (shift.z != 0 ? std::int64_t{size} * size : open));
            int wrong = 0;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x)
                    wrong += plain[static_cast<std::size_t>(y * size + x)] == kept[kept_index(x, y)] ? 0 : 1;
            CHECK(wrong == 0);
        }
    });
}

}  // namespace torus

}  // namespace
