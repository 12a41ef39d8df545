#pragma once
// The view samples of a whole image of triangle ids.

#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/core/id.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/sample/view_sample.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::sample {

/// What the image held; sums to its pixels with `empty` and `unusable`.
struct SampleStats {
    std::uint64_t samples = 0;
    std::uint64_t empty = 0;     ///< Pixels without a triangle.
    std::uint64_t unusable = 0;  ///< Ids or indices out of range, positions that are not finite: no sample.
    std::uint64_t edge_on = 0;   ///< Of `samples`: the plane holds the eye, or there is none (no area).

    SampleStats& operator+=(SampleStats const& other) noexcept {
        samples += other.samples;
        empty += other.empty;
        unusable += other.unusable;
        edge_on += other.edge_on;
        return *this;
    }
    friend bool operator==(SampleStats const&, SampleStats const&) noexcept = default;
};

/// Where the triangles' floats lie in the world, and who looks at them.
struct SampleFrame {
    math::View view;
    math::dvec3 origin_m{0.0, 0.0, 0.0};  ///< World position of work space's zero.
    predicates::TriangleList triangles;
};

/// The sample of pixel (`x`, `y`), which shows triangle `id`.
///
/// returns: a sample without triangle if `id` is none, or not usable.
[[nodiscard]] inline ViewSample sample_at(SampleFrame const& frame, math::ivec2 const& pixel, core::TriangleId id) noexcept {
    if (!is_usable(frame.triangles, id)) return {};
    math::dvec2 const center(pixel.x + 0.5, pixel.y + 0.5);
    return make_view_sample(id, frame.triangles[id], sample_ray(frame.view, frame.origin_m, center),
                            eye_of(frame.view, frame.origin_m));
}

/// Writes the sample of every pixel; `ids` are triangle ids in rows from the top, all ones where there is none.
///
/// expects: `ids` and `out` hold size_px.x * size_px.y elements.
/// returns: the counts; the same for any executor.
template <core::Executor E>
SampleStats make_view_samples(SampleFrame const& frame, std::span<std::uint32_t const> ids, std::span<ViewSample> out,
                              E& executor) {
    auto const columns = static_cast<std::size_t>(frame.view.size_px.x);
    auto const rows = static_cast<std::size_t>(frame.view.size_px.y);
    GNOMON_EXPECT(ids.size() == columns * rows && out.size() == ids.size());
    predicates::Target const eye = eye_of(frame.view, frame.origin_m);
    std::atomic_flag busy;
    SampleStats total;
    executor.parallel_for(rows, 8, [&](std::size_t begin, std::size_t end) {
        SampleStats stats;
        for (std::size_t i = begin * columns; i < end * columns; ++i) {
            core::TriangleId const id(ids[i]);
            math::ivec2 const pixel(static_cast<int>(i % columns), static_cast<int>(i / columns));
            out[i] = sample_at(frame, pixel, id);
            if (out[i].triangle.is_none()) {
                ++(id.is_none() ? stats.empty : stats.unusable);
                continue;
            }
            ++stats.samples;
            auto const t = frame.triangles[id];
            stats.edge_on += predicates::orient3d(t[0], t[1], t[2], eye) == predicates::Sign::zero ? 1U : 0U;
        }
        while (busy.test_and_set(std::memory_order_acquire)) {}
        total += stats;
        busy.clear(std::memory_order_release);
    });
    return total;
}

}  // namespace gnomon::sample
