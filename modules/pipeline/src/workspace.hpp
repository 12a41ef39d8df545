#pragma once
// What one run leaves for the next.

#include <gnomon/pipeline/technique.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/shadow/map_view.hpp>

#include "cascade/cascade_shadows.hpp"
#include "detail.hpp"
#include "lighting/lighting.hpp"
#include "shadow/cached_lights.hpp"
#include "shadow/light_fit.hpp"
#include "shadow/shadow_maps.hpp"
#include "staged.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon::pipeline {

/// Of the technique `shadow-map-cached`.
struct CachedLightRuns {
    ShadowMaps shadow;
    CachedLights lights;
    NearestCaster nearest;
};

/// Of the technique `ray`.
struct Rays {
    StagedSurfaces surfaces;
    StagedBuffer nodes;
    StagedBuffer blocks;
    StagedBuffer answers;
    std::vector<std::uint32_t> answer;
};

/// Of the techniques with cascades.
struct CascadeRuns {
    CascadeShadows shadows;
    math::dvec3 direction{0.0};  ///< Of the light, for the maps.
    std::vector<shadow::MapView> maps;
    StagedBuffer map_views;
    StagedBuffer depths;
    StagedBuffer visibility;
    StagedBuffer bias_m;
};

struct Workspace::State {
    std::unique_ptr<raster::CpuBackend> own;  ///< Outlives what follows.
    backend::Backend* device = nullptr;       ///< Whose ids follow.
    StagedSamples samples;
    ShadowMaps shadow;
    CachedLightRuns cached_lights;
    CascadeRuns cascades;
    Rays rays;
    Lighting lighting;

    /// From here on all is on `to`: what another backend holds is released.
    void move_to(backend::Backend& to) {
        if (device == &to) return;
        clear();
        device = &to;
    }
    void clear() noexcept {
        samples = {};
        shadow = {};
        cached_lights = {};
        cascades = {};
        rays = {};
        lighting = {};
        device = nullptr;
    }
};

}  // namespace gnomon::pipeline
