// The measures of design section 9.

#include "detail.hpp"

#include <gnomon/pipeline/image.hpp>
#include <gnomon/pipeline/measures.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::pipeline {

namespace {

/// For each pixel of a column-major walk: rows to the nearest set pixel of the same column, or `far` for none.
void column_distances(std::span<std::uint8_t const> mask, math::ivec2 size_px, std::int64_t far,
                      std::span<std::int64_t> rows) {
    auto const width = static_cast<std::size_t>(size_px.x);
    auto const height = static_cast<std::size_t>(size_px.y);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            std::size_t const i = y * width + x;
            rows[i] = mask[i] != 0 ? 0 : (y == 0 ? far : std::min(far, rows[i - width] + 1));
        }
    for (std::size_t y = height - 1; y-- > 0;)
        for (std::size_t x = 0; x < width; ++x) {
            std::size_t const i = y * width + x;
            rows[i] = std::min(rows[i], rows[i + width] + 1);
        }
}

std::int64_t floor_div(std::int64_t a, std::int64_t b) noexcept { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/// Lower envelope of the parabolas (x - q)^2 + height[q]; all in integers, so the distances are exact.
class Envelope {
  public:
    explicit Envelope(std::size_t width) : apex_(width), from_(width) {}

    void transform(std::span<std::int64_t> row, std::span<std::int64_t> heights) {
        auto const width = static_cast<std::int64_t>(row.size());
        std::copy(row.begin(), row.end(), heights.begin());
        std::int64_t count = 0;
        for (std::int64_t q = 0; q < width; ++q) count = push(heights, q, count);
        std::int64_t k = count - 1;
        for (std::int64_t x = width - 1; x >= 0 && k >= 0; --x) {
            while (k > 0 && at(from_, k) > x) --k;
            std::int64_t const dx = x - at(apex_, k);
            row[static_cast<std::size_t>(x)] = dx * dx + heights[static_cast<std::size_t>(at(apex_, k))];
        }
    }

  private:
    static std::int64_t& at(std::vector<std::int64_t>& list, std::int64_t i) {
        return list[static_cast<std::size_t>(i)];
    }

    /// The first x at which the parabola of `q` lies below that of `p`, p < q.
    static std::int64_t overtakes(std::span<std::int64_t const> heights, std::int64_t p, std::int64_t q) {
        std::int64_t const hp = heights[static_cast<std::size_t>(p)];
        std::int64_t const hq = heights[static_cast<std::size_t>(q)];
        return floor_div(hq + q * q - hp - p * p, 2 * (q - p)) + 1;
    }

    std::int64_t push(std::span<std::int64_t const> heights, std::int64_t q, std::int64_t count) {
        std::int64_t from = 0;
        while (count > 0) {
            from = overtakes(heights, at(apex_, count - 1), q);
            if (from > at(from_, count - 1)) break;
            --count;
        }
        if (count == 0) from = 0;
        at(apex_, count) = q;
        at(from_, count) = from;
        return count + 1;
    }

    std::vector<std::int64_t> apex_;
    std::vector<std::int64_t> from_;
};

std::vector<std::uint8_t> state_mask(Frame const& frame, std::uint8_t state) {
    std::vector<std::uint8_t> mask(pixel_count(frame.view.size_px), 0);
    for (std::size_t i = 0; i < frame.samples.size(); ++i)
        if (frame.lit[i] == state) mask[frame.samples.pixel[i]] = 1;
    return mask;
}

}  // namespace

Verdict verdict_of(float visibility, std::uint8_t lit) noexcept {
    bool const says_lit = visibility >= 0.5F;
    if (says_lit == (lit != 0)) return Verdict::right;
    return says_lit ? Verdict::false_lit : Verdict::false_shadow;
}

std::vector<std::int64_t> squared_distance(std::span<std::uint8_t const> mask, math::ivec2 size_px) {
    GNOMON_EXPECT(mask.size() == pixel_count(size_px));
    std::vector<std::int64_t> distance(mask.size(), no_distance);
    if (std::find_if(mask.begin(), mask.end(), [](std::uint8_t m) { return m != 0; }) == mask.end()) return distance;
    // Farther than any column is high, and small enough that its square and the rows' sums stay exact.
    std::int64_t const far = std::int64_t{size_px.x} + size_px.y + 1;
    column_distances(mask, size_px, far, distance);
    for (std::int64_t& rows : distance) rows *= rows;
    auto const width = static_cast<std::size_t>(size_px.x);
    Envelope envelope(width);
    std::vector<std::int64_t> heights(width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(size_px.y); ++y)
        envelope.transform(std::span(distance).subspan(y * width, width), heights);
    return distance;
}

double percentile(std::span<double> values, double fraction) {
    if (values.empty()) return 0.0;
    double const rank = std::ceil(fraction * static_cast<double>(values.size()));
    auto const index = static_cast<std::size_t>(std::clamp(rank - 1.0, 0.0, static_cast<double>(values.size() - 1)));
    auto const at = values.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

EdgeError measure_edges(Frame const& frame, std::span<float const> visibility) {
    std::vector<double> distances;
    for (std::uint8_t const state : {std::uint8_t{0}, std::uint8_t{1}}) {
        Verdict const wrong = state != 0 ? Verdict::false_lit : Verdict::false_shadow;
        std::vector<std::int64_t> squared;
        for (std::size_t i = 0; i < frame.samples.size(); ++i) {
            if (verdict_of(visibility[i], frame.lit[i]) != wrong) continue;
            if (squared.empty()) squared = squared_distance(state_mask(frame, state), frame.view.size_px);
            std::int64_t const d = squared[frame.samples.pixel[i]];
            distances.push_back(d == no_distance ? std::numeric_limits<double>::infinity()
                                                 : std::sqrt(static_cast<double>(d)));
        }
    }
    EdgeError edge;
    if (distances.empty()) return edge;
    double sum = 0.0;
    for (double const d : distances) {
        sum += d;
        edge.max = std::max(edge.max, d);
    }
    edge.mean = sum / static_cast<double>(distances.size());
    edge.p99 = percentile(distances, 0.99);
    return edge;
}

Measures measure(Frame const& frame, TechniqueOutput const& output, core::ExecutorRef executor) {
    Measures result;
    std::size_t const n = frame.samples.size();
    GNOMON_EXPECT(output.visibility.size() == n);
    result.samples = n;
    std::vector<double> errors(n);
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        float const truth = frame.lit[i] != 0 ? 1.0F : 0.0F;
        errors[i] = std::abs(static_cast<double>(output.visibility[i]) - static_cast<double>(truth));
        sum += errors[i];
        Verdict const verdict = verdict_of(output.visibility[i], frame.lit[i]);
        result.false_lit += verdict == Verdict::false_lit ? 1U : 0U;
        result.false_shadow += verdict == Verdict::false_shadow ? 1U : 0U;
        bool const own = !output.own_hit.empty() && output.own_hit[i] != 0;
        result.acne += verdict == Verdict::false_shadow && own ? 1U : 0U;
    }
    result.wrong = result.false_lit + result.false_shadow;
    result.detachment = count_detached(frame, output, executor);
    if (n == 0) return result;
    result.wrong_fraction = static_cast<double>(result.wrong) / static_cast<double>(n);
    result.visibility_error_mean = sum / static_cast<double>(n);
    result.visibility_error_p99 = percentile(errors, 0.99);
    result.edge_px = measure_edges(frame, output.visibility);
    return result;
}

}  // namespace gnomon::pipeline
