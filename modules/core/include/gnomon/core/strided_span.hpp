#pragma once
// A view of elements that lie a fixed number of bytes apart, as in an engine's interleaved vertex buffer.

#include <gnomon/core/contract.hpp>

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

namespace gnomon::core {

/// `size` elements of trivially copyable type T, `stride_bytes` apart; T need not be aligned in memory.
template <class T>
    requires std::is_trivially_copyable_v<T>
class StridedSpan {
public:
    constexpr StridedSpan() noexcept = default;

    /// expects: `data` holds `(size - 1) * stride_bytes + sizeof(T)` bytes, if size is not 0.
    StridedSpan(void const* data, std::size_t size, std::size_t stride_bytes) noexcept
        : data_(static_cast<std::byte const*>(data)), size_(size), stride_(stride_bytes) {
        GNOMON_EXPECT(data != nullptr || size == 0);
    }

    StridedSpan(std::span<T const> packed) noexcept  // NOLINT: any packed span is a strided one
        : StridedSpan(packed.data(), packed.size(), sizeof(T)) {}

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] std::size_t stride_bytes() const noexcept { return stride_; }
    [[nodiscard]] std::byte const* data() const noexcept { return data_; }

    /// A copy of element `i`: the bytes may be unaligned, so there is no reference to give.
    [[nodiscard]] T operator[](std::size_t i) const noexcept {
        GNOMON_EXPECT(i < size_);
        T element;
        std::memcpy(&element, data_ + i * stride_, sizeof(T));
        return element;
    }

private:
    std::byte const* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t stride_ = sizeof(T);
};

}  // namespace gnomon::core
