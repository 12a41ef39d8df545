#pragma once
// A world of a few casters over tiny height fields, in which everything that a cache must notice happens at random, and
// which draws every frame from nothing beside what the cache keeps. Shares no rule with the cache: it knows texels only.

#include "faults.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace cache_model {

/// splitmix64: the same numbers everywhere.
struct Random {
    std::uint64_t state;
    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    std::uint64_t next() { return mix(state += 0x9e3779b97f4a7c15ULL); }
    int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
    bool one_in(int n) { return below(n) == 0; }
    int within(int low, int high) { return low + below(high - low + 1); }
};

/// One texel's code of every texel of a volume.
struct Image {
    static constexpr int side = 8;
    std::array<std::int32_t, side * side> code{};
    Volume v{};

    std::int32_t& at(std::int64_t i, std::int64_t j) { return code[static_cast<std::size_t>(j * side + i)]; }
    std::int32_t at(std::int64_t i, std::int64_t j) const { return code[static_cast<std::size_t>(j * side + i)]; }
    std::int32_t far_code() const { return static_cast<std::int32_t>(v.far_code); }
    void clear(Volume const& to) {
        v = to;
        code.fill(far_code());
    }
};

struct Caster {
    cache::ObjectRecord record{};
    Box box{};
    std::uint64_t seed = 0;
    bool there = false;  ///< What is, whatever the record was told.
};

struct Tally {
    std::uint64_t frames = 0;
    std::uint64_t compared = 0;  ///< Valid maps compared texel for texel.
    std::uint64_t partial = 0;
    std::uint64_t postponed = 0;
    std::uint64_t wrong_c = 0;   ///< Maps with a texel that differs.
    std::uint64_t wrong_w = 0;
    std::uint64_t wrong_part = 0;
    std::uint64_t needless = 0;  ///< Frames without any event in which something was drawn to C.
    std::uint64_t wrong_books = 0;
    std::uint64_t near_clamped = 0;  ///< Texels of an eighth of the sequences that a redraw with clipping has otherwise.
    std::uint64_t wrong_near = 0;    ///< Of them those that are not code 0.
    cache::History history{};
    std::uint64_t first_wrong = ~std::uint64_t{0};

    void add(cache::History const& h) {
        history.redraws += h.redraws;
        history.scrolls += h.scrolls;
        history.additions += h.additions;
        history.kept += h.kept;
        history.postponed += h.postponed;
        for (std::size_t i = 0; i < h.by_reason.size(); ++i) history.by_reason[i] += h.by_reason[i];
    }
    std::uint64_t wrong() const { return wrong_c + wrong_w + wrong_part; }
};

/// The caster's depth at a texel of light space, or no depth where it has a hole.
inline bool depth_at(Caster const& c, std::uint64_t epoch, std::int64_t x, std::int64_t y, std::int64_t& depth) {
    // relative to the box: a shape that moves keeps its look
    auto const u = static_cast<std::uint64_t>(x - c.box.x0);
    auto const w = static_cast<std::uint64_t>(y - c.box.y0);
    std::uint64_t const h = Random::mix(c.seed ^ (epoch << 40) ^ (u << 8) ^ (w << 20));
    depth = c.box.z0 + static_cast<std::int64_t>((h >> 8) % static_cast<std::uint64_t>(c.box.z1 - c.box.z0 + 1));
    return h % 8 != 0;
}

/// f(column, row, code, whether the depth lies before the near plane)
template <class F>
void for_texels(Caster const& c, std::uint64_t epoch, Volume const& v, F const& f) {
    if (!c.there) return;
    for (std::int64_t y = std::max(c.box.y0, v.y); y < std::min(c.box.y1, v.y + v.height); ++y)
        for (std::int64_t x = std::max(c.box.x0, v.x); x < std::min(c.box.x1, v.x + v.width); ++x) {
            std::int64_t depth = 0;
            if (depth_at(c, epoch, x, y, depth)) f(x - v.x, y - v.y, std::clamp<std::int64_t>(depth - v.z, 0, v.far_code), depth < v.z);
        }
}

inline void draw(Image& image, Caster const& c, std::uint64_t epoch, cache::TexelRect const& only) {
    Volume const& v = image.v;
    for_texels(c, epoch, v, [&](std::int64_t i, std::int64_t j, std::int64_t code, bool) {
        if (cache::contains(only, {v.x + i, v.y + j, v.x + i + 1, v.y + j + 1})) image.at(i, j) = std::min(image.at(i, j), static_cast<std::int32_t>(code));
    });
}
inline void draw(Image& image, Caster const& c, std::uint64_t epoch) { draw(image, c, epoch, cache::rect_of(image.v)); }

/// Takes back what was drawn to texels that the image showed before it was shifted.
inline void restore_shown(Image& image, Image const& before, cache::Shift const& shift) {
    for (std::int64_t j = 0; j < image.v.height; ++j)
        for (std::int64_t i = 0; i < image.v.width; ++i) {
            std::int64_t const x = i + shift.x;
            std::int64_t const y = j + shift.y;
            if (x >= 0 && y >= 0 && x < image.v.width && y < image.v.height) image.at(i, j) = before.at(i, j);
        }
}

inline void copy_texels(Image& to, Image const& from, cache::TexelRect const& rect) {
    auto const inside = cache::intersection(rect, cache::rect_of(from.v));  // faulty rules may ask for more
    to.v = from.v;
    for (std::int64_t y = inside.y0; y < inside.y1; ++y)
        for (std::int64_t x = inside.x0; x < inside.x1; ++x) to.at(x - to.v.x, y - to.v.y) = from.at(x - to.v.x, y - to.v.y);
}

/// [CSM Scrolling, 4]: what comes from outside is unwritten, far stays far, near is clamped.
inline Image scrolled(Image const& old, Volume const& to, cache::Shift const& shift, Fault fault) {
    Image out;
    out.clear(to);
    for (std::int64_t j = 0; j < to.height; ++j)
        for (std::int64_t i = 0; i < to.width; ++i) {
            std::int64_t const x = i + shift.x;
            std::int64_t const y = j + shift.y;
            if (x < 0 || y < 0 || x >= old.v.width || y >= old.v.height) continue;
            std::int64_t const code = old.at(x, y);
            if (code == old.v.far_code && fault != Fault::far_is_moved) continue;
            std::int64_t const near = fault == Fault::near_is_not_clamped ? -1000000 : 0;
            out.at(i, j) = static_cast<std::int32_t>(std::clamp<std::int64_t>(code - shift.z, near, to.far_code));
        }
    return out;
}

}  // namespace cache_model
