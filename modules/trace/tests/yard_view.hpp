#pragma once
// The view samples of the yard's one camera, found by asking the hierarchy for what each pixel shows.

#include <gnomon/math/view.hpp>
#include <gnomon/sample/image_samples.hpp>
#include <gnomon/trace/build.hpp>
#include <gnomon/trace/query.hpp>

#include "scenes.hpp"

#include <cstdint>
#include <vector>

namespace scenes {

inline std::vector<gnomon::sample::ViewSample> yard_samples(Mesh const& mesh, gnomon::trace::Bvh const& bvh, int size_px) {
    using namespace gnomon;
    math::View const view = math::make_perspective({.eye_m = math::dvec3(0.7, 1.7, -200.3),
                                                    .target_m = math::dvec3(12.0, 5.0, 0.0),
                                                    .size_px = math::ivec2(size_px, size_px)})
                                .value();
    auto const pixels = static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px);
    std::vector<std::uint32_t> ids(pixels, ~0U);
    for (std::size_t i = 0; i < pixels; ++i) {
        math::dvec2 const center(static_cast<double>(i % static_cast<std::size_t>(size_px)) + 0.5,
                                 static_cast<double>(i / static_cast<std::size_t>(size_px)) + 0.5);
        auto const ray = math::pixel_ray(view, center);
        auto const hit = nearest_blocker(bvh, {math::to_float(view.eye_m), Light::direction(math::to_float(ray.step))});
        if (hit) ids[i] = hit->triangle.value;
    }
    std::vector<sample::ViewSample> samples(pixels);
    core::SerialExecutor const serial;
    make_view_samples(sample::SampleFrame{view, math::dvec3(0.0), mesh.list()}, ids, samples, serial);
    return samples;
}

}  // namespace scenes
