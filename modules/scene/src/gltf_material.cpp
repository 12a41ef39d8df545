#include "detail/gltf_parts.hpp"
#include "detail/image_codec.hpp"

#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene::detail {

namespace {

using math::vec2;

/// Rounded to float; numbers beyond it become the largest one.
float to_finite_float(double value) noexcept {
    constexpr double largest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -largest, largest));
}

float number_or(tinygltf::Value const* value, float fallback) {
    return value != nullptr && value->IsNumber() ? to_finite_float(value->GetNumberAsDouble()) : fallback;
}

vec2 pair_or(tinygltf::Value const* value, vec2 const& fallback) {
    if (value == nullptr || value->ArrayLen() != 2) return fallback;
    return {number_or(&value->Get(0), fallback.x), number_or(&value->Get(1), fallback.y)};
}

math::Wrap wrap_of(int mode) noexcept {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return math::Wrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? math::Wrap::mirror : math::Wrap::repeat;
}

class MaterialLoader {
public:
    MaterialLoader(Document& document, Scene& scene)
        : document_(document),
          scene_(scene),
          texture_of_(document.model.textures.size(), none),
          image_of_(document.images.size(), none),
          bytes_left_(document.config.limits.max_image_bytes) {}

    void add(tinygltf::Material const& in, std::size_t index) {
        where_ = item("material", index);
        Material out;
        out.name = in.name;
        auto const& pbr = in.pbrMetallicRoughness;
        for (std::size_t i = 0; i < pbr.baseColorFactor.size() && i < 4; ++i)
            out.base_color[static_cast<int>(i)] = to_finite_float(pbr.baseColorFactor[i]);
        for (std::size_t i = 0; i < in.emissiveFactor.size() && i < 3; ++i)
            out.emissive[static_cast<int>(i)] = to_finite_float(in.emissiveFactor[i]);
        out.metallic = to_finite_float(pbr.metallicFactor);
        out.roughness = to_finite_float(pbr.roughnessFactor);
        out.double_sided = in.doubleSided;
        out.alpha_cutoff = to_finite_float(in.alphaCutoff);
        out.alpha_mode = alpha_mode(in.alphaMode);
        out.base_color_texture = texture_use(pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord,
                                             extension(pbr.baseColorTexture.extensions, "KHR_texture_transform"));
        if (auto const* gloss = extension(in.extensions, "KHR_materials_pbrSpecularGlossiness")) add_diffuse(*gloss, out);
        scene_.materials.push_back(std::move(out));
    }

private:
    AlphaMode alpha_mode(std::string const& mode) {
        if (mode == "MASK") return AlphaMode::mask;
        if (mode == "BLEND") return AlphaMode::blend;
        if (mode != "OPAQUE") document_.warn(where_ + " has the unknown alpha mode " + quoted(mode) + "; it is drawn opaque.");
        return AlphaMode::opaque;
    }

    /// The colours of the older model, which stand in place of the base colour.
    void add_diffuse(tinygltf::Value const& gloss, Material& out) {
        if (auto const* factor = member(gloss, "diffuseFactor"); factor != nullptr && factor->ArrayLen() == 4)
            for (int i = 0; i < 4; ++i) out.base_color[i] = number_or(&factor->Get(i), 1.0F);
        out.metallic = 0.0F;
        auto const* texture = member(gloss, "diffuseTexture");
        if (texture == nullptr) return;
        std::uint32_t const index = whole_or_none(member(*texture, "index"));
        std::uint32_t const uv_set = whole_or_none(member(*texture, "texCoord"));
        auto const* extensions = member(*texture, "extensions");
        out.base_color_texture =
            texture_use(index == none ? -1 : static_cast<int>(index), uv_set == none ? 0 : static_cast<int>(uv_set),
                        extensions != nullptr ? member(*extensions, "KHR_texture_transform") : nullptr);
    }

    TextureUse texture_use(int index, int uv_set, tinygltf::Value const* transform) {
        TextureUse use;
        if (index < 0) return use;
        use.uv_set = static_cast<std::uint32_t>(std::max(uv_set, 0));
        if (transform != nullptr) {
            use.offset = pair_or(member(*transform, "offset"), use.offset);
            use.scale = pair_or(member(*transform, "scale"), use.scale);
            use.rotation_rad = number_or(member(*transform, "rotation"), 0.0F);
            if (std::uint32_t const other = whole_or_none(member(*transform, "texCoord")); other != none) use.uv_set = other;
        }
        if (use.uv_set > 1) {
            document_.warn(where_ + " uses texture coordinate set " + std::to_string(use.uv_set) + "; only 0 and 1 are read, so it has no texture.");
            return TextureUse{};
        }
        use.texture = texture(static_cast<std::size_t>(index));
        return use;
    }

    std::uint32_t texture(std::size_t index) {
        auto const& textures = document_.model.textures;
        if (index >= textures.size())
            fail(SceneError::malformed, where_ + " names texture " + std::to_string(index) + " and there are only " +
                                            std::to_string(textures.size()) + "; export the file again");
        if (texture_of_[index] != none) return texture_of_[index];
        Texture out;
        if (int const sampler = textures[index].sampler; sampler >= 0) {
            auto const& samplers = document_.model.samplers;
            if (static_cast<std::size_t>(sampler) >= samplers.size())
                fail(SceneError::malformed, item("texture", index) + " names sampler " + std::to_string(sampler) +
                                                " and there are only " + std::to_string(samplers.size()) +
                                                "; export the file again");
            tinygltf::Sampler const& s = samplers[static_cast<std::size_t>(sampler)];
            out.wrap_u = wrap_of(s.wrapS);
            out.wrap_v = wrap_of(s.wrapT);
            out.nearest = s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        int const source = textures[index].source;
        if (source >= 0 && static_cast<std::size_t>(source) >= document_.images.size())
            fail(SceneError::malformed, item("texture", index) + " names image " + std::to_string(source) +
                                            " and there are only " + std::to_string(document_.images.size()) +
                                            "; export the file again");
        out.image = source < 0 ? white_image(item("texture", index) + " has no image") : image(static_cast<std::size_t>(source));
        texture_of_[index] = static_cast<std::uint32_t>(scene_.textures.size());
        scene_.textures.push_back(out);
        return texture_of_[index];
    }

    std::uint32_t white_image(std::string const& why) {
        ++document_.notes.failed_images;
        document_.warn(why + "; plain white stands in.");
        Image white;
        white.name = "white";
        white.size_px = math::ivec2(1, 1);
        white.rgba.assign(4, 255);
        scene_.images.push_back(std::move(white));
        return static_cast<std::uint32_t>(scene_.images.size() - 1);
    }

    std::uint32_t image(std::size_t index) {
        if (image_of_[index] != none) return image_of_[index];
        ImageSource const& source = document_.images[index];
        std::string const name = source.name.empty() && !is_data_uri(source.uri) ? source.uri : source.name;
        auto decoded = decode(source);
        if (!decoded) {
            image_of_[index] = white_image("Image " + std::to_string(index) + " " + quoted(name) + " " + decoded.failure().message);
            return image_of_[index];
        }
        decoded->name = name;
        bytes_left_ -= decoded->rgba.size();
        scene_.images.push_back(std::move(decoded).value());
        image_of_[index] = static_cast<std::uint32_t>(scene_.images.size() - 1);
        return image_of_[index];
    }

    core::Result<Image, SceneError> decode(ImageSource const& source) {
        if (!document_.config.load_images) return core::Failure{SceneError::malformed, "is not asked for"};
        if (source.uri.empty() && source.view == none)
            return core::Failure{SceneError::malformed, "has neither a URI nor a buffer view"};
        if (source.uri.empty()) return decode_image(view_bytes(source.view), document_.config.limits, bytes_left_);
        auto bytes = document_.uri_bytes(source.uri);
        if (!bytes) return std::move(bytes).failure();
        return decode_image(*bytes, document_.config.limits, bytes_left_);
    }

    /// A bad range loses the image only.
    [[nodiscard]] std::span<std::byte const> view_bytes(std::uint64_t view) const {
        try {
            return document_.view_bytes(view);
        } catch (LoadFailure const&) {
            return {};
        }
    }

    Document& document_;
    Scene& scene_;
    std::string where_;
    std::vector<std::uint32_t> texture_of_;
    std::vector<std::uint32_t> image_of_;
    std::uint64_t bytes_left_;
};

}  // namespace

void load_materials(Document& document, Scene& scene) {
    MaterialLoader loader(document, scene);
    for (std::size_t i = 0; i < document.model.materials.size(); ++i) loader.add(document.model.materials[i], i);
}

}  // namespace gnomon::scene::detail
