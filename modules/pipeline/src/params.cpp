// The tables of techniques and the reading of their parameters.

#include "detail.hpp"

#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/pipeline/technique.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

namespace gnomon::pipeline {

namespace {

std::array<Technique, 6> const& table() noexcept {
    static std::array<Technique, 6> const all = [] {
        auto const [csm, csm_cached, csm_scroll] = cascade_techniques();
        return std::array{shadow_map_technique(), shadow_map_cached_technique(), csm, csm_cached, csm_scroll, ray_technique()};
    }();
    return all;
}

std::vector<LightingTechnique> const& lighting_table() noexcept {
    static std::vector<LightingTechnique> const all = [] {
        std::vector<LightingTechnique> list{deferred_technique(), deferred_stencil_technique(), tiled_deferred_technique(), tiled_deferred_en_technique(),
                                            tiled_deferred_single_technique(), tiled_deferred_raster_technique()};
        std::span<LightingTechnique const> const clustered = clustered_deferred_techniques();
        list.insert(list.end(), clustered.begin(), clustered.end());
        list.push_back(clustered_deferred_device_technique());
        list.insert(list.end(), {forward_technique(), tiled_forward_technique(), tiled_forward_prez_technique(), clustered_forward_technique()});
        return list;
    }();
    return all;
}

/// Whose parameters are read.
struct Owner {
    std::string_view name;
    std::span<ParamInfo const> params;
};

std::string short_text(double x) {
    std::array<char, 32> buffer{};
    auto const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr;
    return {buffer.data(), end};
}

template <class Items, class Name>
std::string listed(Items const& items, Name name) {
    std::string all;
    for (auto const& item : items) {
        if (!all.empty()) all += ", ";
        all += name(item);
    }
    return all;
}

core::Failure<Error> bad_value(Owner const& owner, ParamInfo const& info, std::string const& text,
                               std::string const& legal) {
    return {Error::bad_value,
            std::string(owner.name) + "." + std::string(info.name) + " is '" + text + "'; it must be " + legal};
}

Result<Params::Value> read_choice(Owner const& owner, ParamInfo const& info, std::string const& text) {
    for (std::size_t i = 0; i < info.choices.size(); ++i)
        if (info.choices[i] == text) return Params::Value{info.name, text, static_cast<double>(i), info.kind};
    return bad_value(owner, info, text,
                     "one of " + listed(info.choices, [](std::string_view word) { return std::string(word); }));
}

Result<Params::Value> read_number(Owner const& owner, ParamInfo const& info, std::string const& text) {
    bool const whole = info.kind == ParamKind::integer;
    std::string const unit = info.unit.empty() ? "" : " " + std::string(info.unit);
    std::string const legal = std::string(whole ? "a whole number" : "a number") + " from " + short_text(info.min) +
                              " to " + short_text(info.max) + unit;
    double number = 0.0;
    char const* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    char const* const end = text.data() + text.size();
    auto const read = std::from_chars(begin, end, number);
    bool const good = read.ec == std::errc{} && read.ptr == end && number >= info.min && number <= info.max &&
                      (!whole || number == std::floor(number));
    if (!good) return bad_value(owner, info, text, legal);
    return Params::Value{info.name, short_text(number), number, info.kind};
}

Result<Params::Value> read_value(Owner const& owner, ParamInfo const& info, std::string const& text) {
    return info.kind == ParamKind::choice ? read_choice(owner, info, text) : read_number(owner, info, text);
}

Params::Value const* find_value(std::span<Params::Value const> values, std::string_view name) noexcept {
    auto const at = std::find_if(values.begin(), values.end(), [&](auto const& value) { return value.name == name; });
    return at == values.end() ? nullptr : &*at;
}

template <class T>
Result<T const*> find_named(std::span<T const> all, std::string_view kind, std::string_view name) {
    for (T const& technique : all)
        if (technique.name == name) return &technique;
    return core::Failure{Error::unknown_technique, "there is no " + std::string(kind) + " '" + std::string(name) + "'; there are " +
                                                       listed(all, [](T const& t) { return std::string(t.name); })};
}

Result<Params> read_params(Owner const& owner, std::span<Setting const> settings) {
    Params params;
    for (ParamInfo const& info : owner.params) {
        auto value = read_value(owner, info, std::string(info.default_text));
        GNOMON_EXPECT(value.has_value());
        if (!value) return std::move(value).failure();
        params.values.push_back(std::move(value).value());
    }
    for (Setting const& setting : settings) {
        auto const info = std::find_if(owner.params.begin(), owner.params.end(),
                                       [&](ParamInfo const& candidate) { return candidate.name == setting.name; });
        if (info == owner.params.end()) {
            std::string const known = listed(owner.params, [](ParamInfo const& p) { return std::string(p.name); });
            return core::Failure{Error::unknown_parameter, "'" + std::string(owner.name) + "' has no parameter '" +
                                                               setting.name + "'; it has " +
                                                               (known.empty() ? "none" : known)};
        }
        auto value = read_value(owner, *info, setting.text);
        if (!value) return std::move(value).failure();
        params.values[static_cast<std::size_t>(info - owner.params.begin())] = std::move(value).value();
    }
    return params;
}

}  // namespace

void add_one(std::string_view name, std::vector<Count>& counts) {
    auto const same = std::find_if(counts.begin(), counts.end(), [&](Count const& c) { return c.name == name; });
    if (same == counts.end()) counts.push_back({name, 1});
    else ++same->value;
}

double Params::number(std::string_view name) const noexcept {
    Value const* const value = find_value(values, name);
    GNOMON_EXPECT(value != nullptr);
    return value == nullptr ? 0.0 : value->number;
}

std::string_view Params::word(std::string_view name) const noexcept {
    Value const* const value = find_value(values, name);
    GNOMON_EXPECT(value != nullptr);
    return value == nullptr ? std::string_view{} : std::string_view{value->text};
}

std::span<Technique const> techniques() noexcept { return table(); }
std::span<LightingTechnique const> lighting_techniques() noexcept { return lighting_table(); }

Result<Technique const*> find_technique(std::string_view name) { return find_named(techniques(), "technique", name); }
Result<LightingTechnique const*> find_lighting_technique(std::string_view name) {
    return find_named(lighting_techniques(), "lighting technique", name);
}

Result<Params> make_params(Technique const& technique, std::span<Setting const> settings) {
    return read_params({technique.name, technique.params}, settings);
}
Result<Params> make_params(LightingTechnique const& technique, std::span<Setting const> settings) {
    return read_params({technique.name, technique.params}, settings);
}

}  // namespace gnomon::pipeline
