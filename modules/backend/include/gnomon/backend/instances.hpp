#pragma once
// Copies of one draw: a matrix for each, read from the caller's own buffer.

#include <gnomon/core/strided_span.hpp>
#include <gnomon/math/vec.hpp>

#include <cstddef>

namespace gnomon::backend {

/// An affine matrix row by row, as ray tracing APIs keep their instances (VkTransformMatrixKHR).
struct Rows3x4 {
    float row[3][4] = {{1.0F, 0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F, 0.0F}};
};

/// The matrices of a draw's instances: 4x4 by columns or 3x4 by rows, any number of bytes apart.
///
/// A default span is no instancing: the draw is drawn once, as it is. A span of no elements draws nothing.
class InstanceSpan {
  public:
    InstanceSpan() noexcept = default;
    InstanceSpan(core::StridedSpan<math::mat4> columns) noexcept  // NOLINT: converts as spans do
        : columns_(columns), kind_(Kind::columns) {}
    InstanceSpan(core::StridedSpan<Rows3x4> rows) noexcept : rows_(rows), kind_(Kind::rows) {}  // NOLINT

    [[nodiscard]] bool is_set() const noexcept { return kind_ != Kind::none; }
    /// 1 without instancing.
    [[nodiscard]] std::size_t size() const noexcept {
        return kind_ == Kind::none ? 1 : kind_ == Kind::rows ? rows_.size() : columns_.size();
    }
    /// A copy of matrix `i`; the identity without instancing.
    [[nodiscard]] math::mat4 operator[](std::size_t i) const noexcept {
        if (kind_ == Kind::columns) return columns_[i];
        math::mat4 m(1.0F);
        if (kind_ == Kind::none) return m;
        Rows3x4 const rows = rows_[i];
        for (math::axis_t column = 0; column < 4; ++column)
            for (math::axis_t row = 0; row < 3; ++row) m[column][row] = rows.row[row][column];
        return m;
    }

  private:
    enum class Kind : unsigned char { none, columns, rows };
    core::StridedSpan<math::mat4> columns_;
    core::StridedSpan<Rows3x4> rows_;
    Kind kind_ = Kind::none;
};

/// The matrix that an instance is drawn with: clip_from_relative * translation(-origin) * instance.
///
/// Each element is summed in double, the four products in order, and rounded to float once: far from the world's origin
/// the translation and the origin cancel without loss.
/// returns: what a pass uses. A draw of its own with this matrix and the origin (0, 0, 0) gives the same image.
[[nodiscard]] inline math::mat4 clip_from_instance(math::mat4 const& clip_from_relative, math::vec3 const& origin,
                                                   math::mat4 const& instance) noexcept {
    math::mat4 product(0.0F);
    for (math::axis_t column = 0; column < 4; ++column) {
        double relative[4];
        auto const w = static_cast<double>(instance[column][3]);
        for (math::axis_t k = 0; k < 3; ++k)
            relative[k] = static_cast<double>(instance[column][k]) - static_cast<double>(origin[k]) * w;
        relative[3] = w;
        for (math::axis_t row = 0; row < 4; ++row) {
            double sum = static_cast<double>(clip_from_relative[0][row]) * relative[0];
            for (math::axis_t k = 1; k < 4; ++k) sum += static_cast<double>(clip_from_relative[k][row]) * relative[k];
            product[column][row] = static_cast<float>(sum);
        }
    }
    return product;
}

}  // namespace gnomon::backend
