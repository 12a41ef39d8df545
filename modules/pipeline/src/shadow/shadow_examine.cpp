// What the measures ask of techniques with maps of whole lights: whose triangles shadow a sample.

#include "shadow_map.hpp"

#include <gnomon/pipeline/measures.hpp>

#include <algorithm>
#include <vector>

namespace gnomon::pipeline {

namespace {

/// One map and the ids of the triangles that its texels are of, on the host.
struct NamedMap {
    std::size_t map = 0;
    std::vector<float> f32;
    std::vector<std::uint16_t> unorm16;
    std::vector<std::uint32_t> id;
};

bool share_a_corner(scene::Geometry const& g, std::uint32_t a, std::uint32_t b) noexcept {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (g.positions[g.indices[std::size_t{a} * 3 + i]] == g.positions[g.indices[std::size_t{b} * 3 + j]])
                return true;
    return false;
}

/// Calls `use` with the map's texels, in the format they have.
template <class Use>
void with_texels(NamedMap const& named, ShadowMapOptions const& options, Use&& use) {
    if (is_narrow(options))
        use(shadow::Texels<std::uint16_t>{named.unorm16.data(), options.resolution});
    else
        use(shadow::Texels<float>{named.f32.data(), options.resolution});
}

/// Whether at least half of what blocks the sample is of its own surface, or its own plane faced away, judged in float.
bool is_own(Frame const& frame, shadow::MapView const& map, NamedMap const& named, ShadowMapOptions const& options, std::size_t i) {
    Samples const& samples = frame.samples;
    shadow::Prepared const ready = shadow::prepare(map, samples.position[i], samples.normal[i], options.lookup);
    if (ready.faces_away) return true;
    float own = 0.0F;
    float all = 0.0F;
    auto const tally = [&](std::int32_t x, std::int32_t y, float weight, bool blocked) {
        if (!blocked) return;
        std::uint32_t const id = named.id[static_cast<std::size_t>(y) * static_cast<std::size_t>(options.resolution) +
                                          static_cast<std::size_t>(x)];
        bool const mine = id != backend::no_triangle && share_a_corner(*frame.geometry, id, samples.triangle[i]);
        all += weight;
        own += mine ? weight : 0.0F;
    };
    with_texels(named, options,
                [&](auto texels) { shadow::for_each_tap(map, texels, ready, options.lookup.taps, tally); });
    return all > 0.0F && own >= 0.5F * all;
}

/// Draws a map once more, with ids, and reads both back.
void name_map(Verbs& verbs, TechniqueRun const& on, ShadowMaps const& shadow, backend::TargetId ids, NamedMap& named) {
    ShadowMapOptions const options = read_shadow_map_options(on.params);
    backend::PassLayer const layer = layer_of(on.frame, shadow, options, named.map);
    backend::Rect const whole{0, 0, options.resolution, options.resolution};
    verbs(on.device.draw(shadow.list.get(), ids, {&layer, 1}));
    verbs(on.device.read({ids, 0, backend::Plane::triangle, whole}, std::as_writable_bytes(std::span(named.id))));
    auto const bytes = is_narrow(options) ? std::as_writable_bytes(std::span(named.unorm16))
                                          : std::as_writable_bytes(std::span(named.f32));
    auto const of_map = static_cast<std::uint32_t>(named.map);
    verbs(on.device.read({shadow.target.get(), of_map, backend::Plane::depth, whole}, bytes));
    verbs(on.device.finish());
}

}  // namespace

Result<core::Done> examine_maps(TechniqueRun const& on, ShadowMaps const& shadow, TechniqueOutput& output) {
    ShadowMapOptions const options = read_shadow_map_options(on.params);
    Frame const& frame = on.frame;
    std::size_t const n = frame.samples.size();
    output.own_hit.assign(n, 0);
    Verbs verbs(on.device);
    Held const ids(on.device,
                   verbs(on.device.make_target(
                       {.size_px = math::ivec2(options.resolution, options.resolution), .triangle_ids = true})));
    NamedMap named;
    named.id.resize(map_texels(options));
    if (is_narrow(options)) named.unorm16.resize(map_texels(options));
    if (!is_narrow(options)) named.f32.resize(map_texels(options));
    std::size_t const maps = shadow.maps.size();
    for (named.map = 0; named.map < maps; ++named.map) {
        name_map(verbs, on, shadow, ids.get(), named);
        if (!verbs.good()) return verbs.failure();
        on.executor.parallel_for(n, sample_grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (verdict_of(output.visibility[i], frame.lit[i]) != Verdict::false_shadow) continue;
                if (map_of(frame.samples.position[i], shadow.at.position, maps) != named.map) continue;
                output.own_hit[i] = is_own(frame, shadow.maps[named.map], named, options, i) ? 1 : 0;
            }
        });
    }
    return core::Done{};
}

}  // namespace gnomon::pipeline
