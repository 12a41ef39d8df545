#include "stage_draws.hpp"

#include <gnomon/math/scalar.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace gnomon::vulkan::detail {

namespace {

/// Places of spans that were copied already.
using Key = std::tuple<void const*, std::size_t, std::size_t>;
using Places = std::map<Key, std::uint32_t>;

constexpr std::uint64_t max_count = 0x7FFF'FFFFU;

bool is_finite(math::vec3 const& p) noexcept {
    return math::is_finite(p.x) && math::is_finite(p.y) && math::is_finite(p.z);
}

class Stager {
  public:
    explicit Stager(bool alpha_tests) : alpha_tests_(alpha_tests) {}

    Result<core::Done> add(backend::Draw const& draw) {
        std::uint32_t const first_position = add_positions(draw.positions);
        std::size_t const triangles = backend::triangle_count(draw);
        std::size_t const instances = draw.instances.size();
        std::uint64_t const positions = draw.positions.size();
        out.ranges.push_back({first_position, static_cast<std::uint32_t>(positions)});
        if (out.positions.size() / 3 > max_count || out.indices.size() + triangles * 3 > max_count ||
            out.items.size() + instances > max_count)
            return core::Failure{Error::too_large, "a draw list of more than 2^31 positions, indices or instances: split it"};
        count_loose(draw);
        if (triangles == 0 || instances == 0) return core::Done{};
        DrawCommand command;
        command.corners = static_cast<std::uint32_t>(triangles * 3);
        command.first_index = static_cast<std::uint32_t>(out.indices.size());
        command.first_position = first_position;
        command.first_item = static_cast<std::uint32_t>(out.items.size());
        command.instances = static_cast<std::uint32_t>(instances);
        command.draw = static_cast<std::uint32_t>(out.ranges.size() - 1);
        command.state.cull = draw.cull;
        ItemData item{};
        item.first_triangle = draw.first_triangle;
        item.matrix = none;
        item.alpha = add_alpha_test(draw, item, first_position);
        item.groups[0] = static_cast<std::uint32_t>(draw.groups);
        item.groups[1] = static_cast<std::uint32_t>(draw.groups >> 32U);
        item.first_index = command.first_index;
        item.first_position = first_position;
        command.state.masked = item.alpha != none;
        add_indices(draw, triangles);
        add_items(draw, item, static_cast<std::uint32_t>(triangles));
        out.commands.push_back(command);
        add_to_groups(draw.groups, std::uint64_t{triangles} * instances);
        return core::Done{};
    }

    StagedDraws out;

  private:
    std::uint32_t add_positions(core::StridedSpan<math::vec3> const& span) {
        auto const [place, is_new] = positions_.try_emplace({span.data(), span.stride_bytes(), span.size()},
                                                            static_cast<std::uint32_t>(out.positions.size() / 3));
        if (!is_new) return place->second;
        for (std::size_t i = 0; i < span.size(); ++i) {
            math::vec3 const p = span[i];
            out.positions.insert(out.positions.end(), {p.x, p.y, p.z});
        }
        return place->second;
    }

    void count_loose(backend::Draw const& draw) {
        std::size_t const corners = draw.indices.empty() ? draw.positions.size() : draw.indices.size();
        out.faults.loose_indices += static_cast<std::uint32_t>(corners % 3);
    }

    /// Bad triangles become one corner thrice, so that ids and counts stay.
    void add_indices(backend::Draw const& draw, std::size_t triangles) {
        for (std::size_t t = 0; t < triangles; ++t) {
            std::uint32_t corner[3];
            bool is_bad = false;
            bool is_infinite = false;
            for (std::size_t i = 0; i < 3; ++i) {
                std::size_t const at = 3 * t + i;
                corner[i] = draw.indices.empty() ? static_cast<std::uint32_t>(at) : draw.indices[at];
                is_bad = is_bad || corner[i] >= draw.positions.size();
                is_infinite = is_infinite || (!is_bad && !is_finite(draw.positions[corner[i]]));
            }
            out.faults.bad_index_triangles += is_bad ? 1U : 0U;
            out.faults.not_finite_triangles += !is_bad && is_infinite ? 1U : 0U;
            if (is_bad || is_infinite) corner[0] = corner[1] = corner[2] = 0;
            out.indices.insert(out.indices.end(), corner, corner + 3);
        }
        // Corner 0 must be there to be fetched, even where all are bad.
        if (draw.positions.empty()) pad_positions();
    }

    void pad_positions() { out.positions.insert(out.positions.end(), 3, 0.0F); }

    void add_items(backend::Draw const& draw, ItemData item, std::uint32_t triangles) {
        for (std::size_t i = 0; i < draw.instances.size(); ++i) {
            if (draw.instances.is_set()) {
                item.matrix = static_cast<std::uint32_t>(out.instances.size());
                out.instances.push_back(draw.instances[i]);
            }
            out.items.push_back(item);
            item.first_triangle += triangles;
        }
    }

    void add_to_groups(std::uint64_t groups, std::uint64_t triangles) {
        out.triangles += triangles;
        for (GroupTriangles& known : out.groups)
            if (known.groups == groups) {
                known.triangles += triangles;
                return;
            }
        out.groups.push_back({groups, triangles});
    }

    /// returns: the test's place, or none for a solid draw.
    std::uint32_t add_alpha_test(backend::Draw const& draw, ItemData& item, std::uint32_t first_position) {
        if (draw.alpha_test == nullptr || !alpha_tests_) return none;
        backend::AlphaTest const& test = *draw.alpha_test;
        if (test.uv.size() < draw.positions.size() || !math::is_complete(test.texture)) {
            ++out.faults.broken_alpha_tests;
            return none;
        }
        item.uv_shift = add_coordinates(test.uv, draw.positions.size()) - first_position;
        AlphaData data{};
        data.first_texel = add_texels(test.texture);
        data.width = test.texture.size_px.x;
        data.height = test.texture.size_px.y;
        data.wrap_u = static_cast<std::uint32_t>(test.texture.wrap_u);
        data.wrap_v = static_cast<std::uint32_t>(test.texture.wrap_v);
        LeastAlpha const least = least_alpha(test.factor, test.cutoff);
        data.least = least.single;
        std::memcpy(data.least_exact, &least.exact, sizeof least.exact);
        for (std::size_t i = 0; i < out.alpha_tests.size(); ++i)
            if (is_same(out.alpha_tests[i], data)) return static_cast<std::uint32_t>(i);
        out.alpha_tests.push_back(data);
        return static_cast<std::uint32_t>(out.alpha_tests.size() - 1);
    }

    static bool is_same(AlphaData const& a, AlphaData const& b) noexcept {
        return a.first_texel == b.first_texel && a.width == b.width && a.height == b.height && a.wrap_u == b.wrap_u &&
               a.wrap_v == b.wrap_v && a.least == b.least && a.least_exact[0] == b.least_exact[0] &&
               a.least_exact[1] == b.least_exact[1];
    }

    std::uint32_t add_coordinates(core::StridedSpan<math::vec2> const& uv, std::size_t count) {
        auto const [place, is_new] = coordinates_.try_emplace({uv.data(), uv.stride_bytes(), count},
                                                              static_cast<std::uint32_t>(out.coordinates.size() / 2));
        if (!is_new) return place->second;
        for (std::size_t i = 0; i < count; ++i) {
            math::vec2 const at = uv[i];
            out.coordinates.insert(out.coordinates.end(), {at.x, at.y});
        }
        return place->second;
    }

    std::uint32_t add_texels(math::AlphaTexture const& texture) {
        auto const channels = static_cast<std::size_t>(texture.channels);
        std::size_t const count =
            static_cast<std::size_t>(texture.size_px.x) * static_cast<std::size_t>(texture.size_px.y);
        auto const [place, is_new] = texels_.try_emplace({texture.texels.data(), channels, count},
                                                         static_cast<std::uint32_t>(out.texels.size()));
        if (!is_new) return place->second;
        out.texels.reserve(out.texels.size() + count);
        for (std::size_t i = 0; i < count; ++i) out.texels.push_back(texture.texels[(i + 1) * channels - 1]);
        return place->second;
    }

    bool alpha_tests_;
    Places positions_;
    Places coordinates_;
    Places texels_;
};

}  // namespace

namespace {

/// The least number s in [0, 255] with s / 255 * factor >= cutoff, by bisection.
template <class T>
T least_passing(double factor, double cutoff) noexcept {
    auto const passes = [&](T s) { return static_cast<double>(s) / 255.0 * factor >= cutoff; };
    if (!passes(T{255})) return std::numeric_limits<T>::infinity();
    if (passes(T{0})) return T{-1};
    T low{0};
    T high{255};
    while (std::nextafter(low, high) < high) {
        T const middle = low + (high - low) / 2;
        T const at = middle > low && middle < high ? middle : std::nextafter(low, high);
        (passes(at) ? high : low) = at;
    }
    return high;
}

}  // namespace

LeastAlpha least_alpha(double factor, double cutoff) noexcept {
    float const single = least_passing<float>(factor, cutoff);
    bool const is_tiny = single > 0.0F && single < 0x1p-100F;  // Devices may take denormals for 0.
    return {is_tiny ? 0x1p-100F : single, least_passing<double>(factor, cutoff)};
}

Result<StagedDraws> stage_draws(std::span<backend::Draw const> draws, bool alpha_tests) {
    Stager stager(alpha_tests);
    for (backend::Draw const& draw : draws)
        if (auto added = stager.add(draw); !added) return std::move(added).failure();
    if (stager.out.texels.size() > 0xFFFF'FFFCU)
        return core::Failure{Error::too_large, "alpha textures of " + std::to_string(stager.out.texels.size()) +
                                                   " texels in one draw list; 2^32 - 4 may be: split it"};
    return std::move(stager.out);
}

}  // namespace gnomon::vulkan::detail
