#pragma once
// How wrong a technique is: the measures of design section 9, against the exact truth of the same samples.

#include <gnomon/math/vec.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/pipeline/technique.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// Distances in pixels from each wrong sample to the nearest sample that truly has the state it was given.
///
/// Infinite where no sample of the truth has that state (a report writes null); 0 where nothing is wrong.
struct EdgeError {
    double mean = 0.0;
    double p99 = 0.0;
    double max = 0.0;
};

struct Measures {
    std::uint64_t samples = 0;
    std::uint64_t wrong = 0;         ///< State (visibility >= 0.5 is lit) differs from the truth.
    std::uint64_t false_lit = 0;     ///< Lit, truly in shadow.
    std::uint64_t false_shadow = 0;  ///< In shadow, truly lit.
    std::uint64_t acne =
        0;  ///< Of false_shadow: blocked by the sample's own triangle or one that shares a vertex position.
    std::uint64_t detachment = 0;        ///< Of false_lit: the nearest true blocker lies within the bias applied there.
    double wrong_fraction = 0.0;         ///< wrong / samples; 0 without samples.
    double visibility_error_mean = 0.0;  ///< Of |visibility - truth|.
    double visibility_error_p99 = 0.0;
    EdgeError edge_px;
    double radiance_error = 0.0;  ///< RMS difference of the linear radiance over the exact one's RMS.
};

/// Per sample: 0 right, 1 false-lit, 2 false-shadow.
enum class Verdict : std::uint8_t {
    right,
    false_lit,
    false_shadow,
};

[[nodiscard]] Verdict verdict_of(float visibility, std::uint8_t lit) noexcept;

/// Squared Euclidean distance in pixels from each pixel to the nearest one whose `mask` is not 0, exact.
///
/// returns: 0 on the mask itself, `no_distance` everywhere for an empty mask. Two linear passes over the image.
/// source:  [Felzenszwalb and Huttenlocher 2012, Distance Transforms of Sampled Functions], in integers
inline constexpr std::int64_t no_distance = std::int64_t{1} << 62;
[[nodiscard]] std::vector<std::int64_t> squared_distance(std::span<std::uint8_t const> mask, math::ivec2 size_px);

/// The value below or at which `fraction` of `values` lie (nearest rank); reorders `values`. 0 for none.
[[nodiscard]] double percentile(std::span<double> values, double fraction);

[[nodiscard]] EdgeError measure_edges(Frame const& frame, std::span<float const> visibility);

/// Everything but the radiance error, which needs shading (see compare in report.hpp).
[[nodiscard]] Measures measure(Frame const& frame, TechniqueOutput const& output, core::ExecutorRef executor);

}  // namespace gnomon::pipeline
