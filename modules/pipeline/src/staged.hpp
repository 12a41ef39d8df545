#pragma once
// What techniques keep on a backend between runs, and how a row of verbs is called.

#include <gnomon/backend/verbs.hpp>
#include <gnomon/pipeline/error.hpp>
#include <gnomon/pipeline/frame.hpp>

#include "frame_state.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace gnomon::pipeline {

/// Calls of verbs in a row, of which the first failure counts. Those after it are made, and refused or harmless.
class Verbs {
  public:
    explicit Verbs(backend::Backend& device) noexcept : device_(&device) {}

    /// The value; a default one where there is none.
    template <class T>
    T operator()(backend::Result<T> result) {
        if (result) return std::move(result).value();
        if (!failure_) failure_ = std::move(result).failure();
        return T{};
    }
    [[nodiscard]] bool good() const noexcept { return !failure_; }
    /// expects: `!good()`.
    [[nodiscard]] core::Failure<Error> failure() const;

    [[nodiscard]] backend::Backend& device() const noexcept { return *device_; }

  private:
    backend::Backend* device_;
    std::optional<core::Failure<backend::Error>> failure_;
};

/// An id that is released with its holder.
template <class Id>
class Held {
  public:
    Held() = default;
    Held(backend::Backend& device, Id id) noexcept : device_(&device), id_(id) {}
    Held(Held&& other) noexcept
        : device_(std::exchange(other.device_, nullptr)), id_(std::exchange(other.id_, Id::none())) {}
    Held& operator=(Held&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(id_, other.id_);
        return *this;
    }
    ~Held() {
        if (!id_.is_none()) (void)device_->release(id_);
    }

    [[nodiscard]] Id get() const noexcept { return id_; }

  private:
    backend::Backend* device_ = nullptr;
    Id id_;
};

/// A buffer that grows where it must.
class StagedBuffer {
  public:
    /// At least `bytes`, and at least one word: a binding needs something. Contents are lost when it grows.
    backend::BufferId fit(Verbs& verbs, std::size_t bytes);
    /// The same, filled.
    template <class T>
    backend::BufferId fill(Verbs& verbs, std::span<T const> data) {
        backend::BufferId const id = fit(verbs, data.size_bytes());
        if (!data.empty()) verbs(verbs.device().write(id, 0, std::as_bytes(data)));
        return id;
    }
    [[nodiscard]] backend::BufferId get() const noexcept { return held_.get(); }

  private:
    Held<backend::BufferId> held_;
    std::size_t bytes_ = 0;
};

/// The samples of a frame on the backend; kernels.hpp says how they lie.
struct StagedSamples {
    std::shared_ptr<FrameState const> of;  ///< Kept, so that no other frame is taken for it.
    StagedBuffer samples;
    StagedBuffer normals;
    StagedBuffer reached;

    /// Writes them, unless this frame's are there.
    void fit(Verbs& verbs, Frame const& frame);
};

/// The triangles and their holes, as rays see them.
struct StagedSurfaces {
    std::shared_ptr<Surfaces const> of;
    StagedBuffer positions;
    StagedBuffer corners;
    StagedBuffer material_of;
    StagedBuffer materials;
    StagedBuffer textures;
    StagedBuffer texels;
    StagedBuffer corner_uv;

    void fit(Verbs& verbs, Frame const& frame);
};

}  // namespace gnomon::pipeline
