#pragma once
// Raw storage that only grows, for data that is written before it is read.

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

namespace gnomon::raster::detail {

template <class T>
requires std::is_trivially_copyable_v<T>
class Buffer {
  public:
    Buffer() = default;
    Buffer(Buffer&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), capacity_(std::exchange(other.capacity_, 0)) {}
    Buffer& operator=(Buffer&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(capacity_, other.capacity_);
        return *this;
    }
    ~Buffer() { ::operator delete (data_, std::align_val_t{64}); }

    /// Room for `size` elements; the first `kept` survive a move.
    T* fit(std::size_t size, std::size_t kept = 0) {
        if (size <= capacity_) return data_;
        std::size_t const larger = size + size / 4;
        T* const fresh = static_cast<T*>(::operator new (larger * sizeof(T), std::align_val_t{64}));
        if (kept != 0) __builtin_memcpy(static_cast<void*>(fresh), static_cast<void const*>(data_), kept * sizeof(T));
        ::operator delete (data_, std::align_val_t{64});
        data_ = fresh;
        capacity_ = larger;
        return data_;
    }

    [[nodiscard]] T* data() const noexcept { return data_; }
    [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
    [[nodiscard]] std::size_t size_bytes() const noexcept { return capacity_ * sizeof(T); }

  private:
    T* data_ = nullptr;
    std::size_t capacity_ = 0;
};

}  // namespace gnomon::raster::detail
