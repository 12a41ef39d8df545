#pragma once
// The truth for a whole image: one bit per view sample, set where the sample is in shadow.

#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/core/id.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/trace/query.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::trace {

/// What a sample must have: its triangle (none: no surface here) and its position, in the triangles' space.
template <class S>
concept SampleLike = requires(S const& s) {
    { s.triangle } -> std::convertible_to<core::TriangleId>;
    { s.position } -> std::convertible_to<math::vec3>;
};

/// Who looks: with it, a sample whose own plane strictly separates eye and light is in shadow.
struct OwnPlane {
    predicates::TriangleList triangles;
    predicates::Target eye;
};

struct VisibilityStats {
    std::uint64_t samples = 0;     ///< With a triangle.
    std::uint64_t in_shadow = 0;   ///< Of those, blocked or facing away.
    std::uint64_t facing_away = 0; ///< Of those, in shadow by their own plane; not traced.
    std::uint64_t invalid = 0;     ///< NaN or infinite position, or the light is not valid: lit, not traced.
    Counts counts;

    VisibilityStats& operator+=(VisibilityStats const& other) noexcept {
        samples += other.samples;
        in_shadow += other.in_shadow;
        facing_away += other.facing_away;
        invalid += other.invalid;
        counts += other.counts;
        return *this;
    }
    friend bool operator==(VisibilityStats const&, VisibilityStats const&) noexcept = default;
};

/// Words of 64 bits that `visibility` writes for `samples` samples.
[[nodiscard]] constexpr std::size_t visibility_words(std::size_t samples) noexcept { return (samples + 63) / 64; }

/// Bit `i` of what `visibility` wrote.
[[nodiscard]] inline bool is_in_shadow(std::span<std::uint64_t const> bits, std::size_t i) noexcept {
    GNOMON_EXPECT(i / 64 < bits.size());
    return (bits[i / 64] >> (i % 64) & 1U) != 0;
}

namespace detail {

/// The own plane strictly separates eye and light.
[[nodiscard]] inline bool faces_away(OwnPlane const& plane, core::TriangleId id, Light const& light) noexcept {
    if (!is_usable(plane.triangles, id)) return false;
    Triangle const t = plane.triangles[id];
    return predicates::separates(t[0], t[1], t[2], plane.eye, light);
}

}  // namespace detail

/// What `visibility` is asked, beyond the samples.
template <Opacity F = Solid>
struct VisibilityConfig {
    Light light;
    std::optional<OwnPlane> own_plane = {};  ///< None: the own triangle is left out and nothing more.
    F opacity{};
};

/// Whether one sample is in shadow of the config's light: bit i of `visibility`, which says what a bad sample is.
template <SampleLike S, Opacity F>
[[nodiscard]] bool is_shadowed(BvhView bvh, S const& sample, VisibilityConfig<F> const& config, VisibilityStats& stats) {
    core::TriangleId const id = sample.triangle;
    if (id.is_none()) return false;
    ++stats.samples;
    Segment const segment{sample.position, config.light};
    if (!is_valid(segment)) {
        ++stats.invalid;
        return false;
    }
    bool const away = config.own_plane && detail::faces_away(*config.own_plane, id, config.light);
    stats.facing_away += away ? 1U : 0U;
    bool const shadowed = away || is_blocked(bvh, segment, id, stats.counts, config.opacity);
    stats.in_shadow += shadowed ? 1U : 0U;
    return shadowed;
}

/// Sets bit i of `shadow` where sample i is in shadow of the config's light; clears all others, those behind the last too.
///
/// expects: `shadow` holds `visibility_words(samples.size())` words.
/// returns: sums that do not depend on the executor. A NaN or infinite sample, or light, is lit and counted invalid.
/// cost:    one query per sample; no allocation.
template <SampleLike S, core::Executor E, Opacity F = Solid>
VisibilityStats visibility(BvhView bvh, std::span<S const> samples, std::span<std::uint64_t> shadow, E& executor,
                           VisibilityConfig<F> const& config) {
    std::size_t const words = visibility_words(samples.size());
    GNOMON_EXPECT(shadow.size() >= words);
    std::atomic_flag busy;
    VisibilityStats total;
    executor.parallel_for(words, 16, [&](std::size_t begin, std::size_t end) {
        VisibilityStats stats;
        for (std::size_t word = begin; word < end; ++word) {
            std::size_t const first = word * 64;
            std::size_t const end_of_word = std::min(first + 64, samples.size());
            std::uint64_t bits = 0;
            for (std::size_t i = first; i < end_of_word; ++i)
                if (is_shadowed(bvh, samples[i], config, stats)) bits |= std::uint64_t{1} << (i - first);
            shadow[word] = bits;
        }
        while (busy.test_and_set(std::memory_order_acquire)) {}
        total += stats;
        busy.clear(std::memory_order_release);
    });
    return total;
}

}  // namespace gnomon::trace
