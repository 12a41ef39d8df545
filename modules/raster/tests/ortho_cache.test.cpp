// The proof of three modules at once: what `cache` keeps, `cascade` scrolls and the orthographic pass draws on top is the
// map that the pass draws from nothing, bit for bit.

#include <gnomon/cache.hpp>
#include <gnomon/cascade/scroll.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/raster/ortho.hpp>

#include "oracle.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::raster;
using oracle::Random;
using cache::ObjectEvent;
using cache::ObjectState;

constexpr std::int32_t side = 64;

struct Mover {
    math::vec3 at{};
    std::vector<math::vec3> shape;  // triangles about `at`
    std::vector<math::vec3> corners;
    cache::ObjectRecord record{};
    cache::Box box{};
};

template <class T>
struct KeptMap {
    using Texels = std::vector<T>;
    Texels c = Texels(side * side, T(7));
    Texels w = Texels(side * side, T(7));
    Texels other = Texels(side * side);
};

struct Count {
    int frames = 0;
    int wrong = 0;
    std::int64_t drawn = 0;    // casters drawn by the cache
    std::int64_t redrawn = 0;  // and from nothing
    cache::History history{};
};

template <class T>
class Walk {
public:
    Walk(math::Depth depth, double far_m, std::uint64_t seed) : depth_(depth), random_{seed}, scene_m_(far_m, -0.5 * far_m, far_m), anchor_m_(scene_m_) {
        movers_.resize(30);
        for (Mover& m : movers_) {
            m.at = somewhere();
            reshape(m);
            tell(m, ObjectEvent::appeared);
            if (random_.in(0, 3) != 0) tell(m, ObjectEvent::rested);
        }
    }

    Count run(int frames) {
        for (int f = 0; f < frames; ++f) {
            happen();
            frame(random_.in(0, 9) == 0 && f + 1 < frames);
        }
        count_.frames = frames;
        count_.history = map_.history();
        return count_;
    }

private:
    static constexpr bool is_unorm16 = sizeof(T) == 2;
    static constexpr std::int32_t codes = is_unorm16 ? cascade::unorm16_codes : cascade::float_codes;

    float spread(float reach) { return (random_.unit() * 2.0F - 1.0F) * reach; }
    math::vec3 somewhere() {
        float const x = spread(4.0F);
        float const y = spread(4.0F);
        float const z = spread(4.0F);
        return {x, y, z};
    }
    void reshape(Mover& m) {
        m.shape.clear();
        if (random_.in(0, 1) == 0) {  // a panel that faces the light: all of its border reaches as far as its box
            float const u = random_.unit() * 0.6F;
            float const v = random_.unit() * 0.6F;
            math::vec3 const right(0.6F * u, 0.0F, 0.8F * u);
            math::vec3 const up(0.0F, v, 0.0F);
            m.shape = {math::vec3(0.0F) - right - up, right - up, right + up, math::vec3(0.0F) - right - up, right + up, up - right};
            return;
        }
        for (int i = 0; i < 18; ++i) {
            float const x = spread(0.6F);
            float const y = spread(0.6F);
            float const z = spread(0.6F);
            m.shape.push_back({x, y, z});
        }
    }
    void tell(Mover& m, ObjectEvent event) {
        m.record = cache::advance(m.record, event, 0);
        m.corners.clear();
        for (math::vec3 const& p : m.shape) m.corners.push_back(m.at + p);
    }
    void happen() {
        Mover& m = movers_[static_cast<std::size_t>(random_.in(0, 29))];
        switch (random_.in(0, 11)) {
            case 0: reshape(m), tell(m, ObjectEvent::deformed); break;
            case 1: m.at = m.at + math::vec3(0.1F, 0.0F, 0.03F), tell(m, ObjectEvent::moved); break;
            case 2: m.at = somewhere(), tell(m, ObjectEvent::teleported); break;
            case 3: tell(m, ObjectEvent::hidden); break;
            case 4: tell(m, ObjectEvent::shown); break;
            case 5: m.at = somewhere(), reshape(m), tell(m, ObjectEvent::appeared); break;
            case 6: tell(m, ObjectEvent::deleted); break;
            default: break;
        }
        for (Mover& o : movers_)
            if (o.record.state == ObjectState::active && random_.in(0, 5) == 0) tell(o, ObjectEvent::rested);
        volume_.x += random_.in(-4, 4);
        volume_.y += random_.in(-4, 4);
        volume_.z += random_.in(-codes / 20, codes / 20);
        if (random_.in(0, 15) == 0) volume_.x += random_.in(0, 1) == 0 ? -side : side;
        if (random_.in(0, 7) == 0) volume_.x /= 2, volume_.y /= 2, volume_.z = volume_.z / 2 - codes / 4;  // back to the scene
        if (random_.in(0, 31) == 0) {
            math::dvec3 const by(random_.in(-1000, 1000), random_.in(-1000, 1000), random_.in(-1000, 1000));
            scene_m_ = scene_m_ + by;
            anchor_m_ = anchor_m_ + by;
            map_.notify(cache::MapEvent::origin_rebased);
        }
    }
    cache::LightUnits light() const { return {{0.6, 0.0, 0.8}, {0.0, -1.0, 0.0}, {-0.8, 0.0, 0.6}, 0.0625, 8.0 / codes}; }

    void draw(std::vector<T>& to, std::span<Mover const* const> list) {
        auto const units = light();
        IntegerOrtho const ortho{units.right, units.down, units.away, units.texel_m, units.depth_unit_m, volume_.x, volume_.y, volume_.z};
        draws_.clear();
        for (Mover const* const m : list)
            draws_.push_back({.positions = std::span<math::vec3 const>(m->corners), .indices = {}, .origin_m = scene_m_ - anchor_m_});
        core::SerialExecutor const serial;
        (void)ortho_pass(draws_, ortho, make_image(to.data(), side, side), {.depth = depth_, .load = Load::keep}, workspace_, serial);
    }
    void clear(std::vector<T>& to) const {
        T const far = depth_ == math::Depth::reversed ? T(0) : is_unorm16 ? static_cast<T>(codes) : T(1);
        std::fill(to.begin(), to.end(), far);
    }

    void list_objects() {
        objects_.clear();
        auto const units = light();
        for (std::uint32_t i = 0; i < movers_.size(); ++i) {
            Mover& m = movers_[i];
            cache::LightBounds bounds(units);
            for (math::vec3 const& p : m.corners) bounds.add((scene_m_ - anchor_m_) + math::to_double(p));
            m.box = bounds.box().value_or(cache::Box{});
            objects_.push_back(make_object(cache::ObjectId{i}, m.record, m.box));
        }
    }

    void frame(bool postponed) {
        list_objects();
        volume_.width = volume_.height = side;
        volume_.far_code = codes;
        auto const& plan = map_.plan(volume_, objects_);
        if (postponed) return map_.postpone();
        perform(plan);
        map_.commit();
        compare();
    }
    std::vector<Mover const*> chosen(std::span<std::uint32_t const> places) const {
        std::vector<Mover const*> list;
        for (std::uint32_t const i : places) list.push_back(&movers_[objects_[i].id.index()]);
        return list;
    }
    void perform(cache::Plan const& plan) {
        if (plan.action == cache::MapAction::redraw) clear(kept_.c);
        if (plan.action == cache::MapAction::scroll) {
            cascade::MapTexels<T const> const from{kept_.c.data(), side, side};
            cascade::scroll(from, cascade::MapTexels<T>{kept_.other.data(), side, side}, {{plan.shift.x, plan.shift.y, plan.shift.z}, codes, depth_});
            kept_.c.swap(kept_.other);
        }
        draw(kept_.c, chosen(plan.statics));
        if (plan.compose != cache::Compose::keep)
            for (std::int64_t y = plan.copied.y0 - volume_.y; y < plan.copied.y1 - volume_.y; ++y)
                for (std::int64_t x = plan.copied.x0 - volume_.x; x < plan.copied.x1 - volume_.x; ++x)
                    kept_.w[static_cast<std::size_t>(y * side + x)] = kept_.c[static_cast<std::size_t>(y * side + x)];
        draw(kept_.w, chosen(plan.actives));
        count_.drawn += static_cast<std::int64_t>(plan.statics.size() + plan.actives.size());
    }
    void compare() {
        std::vector<Mover const*> still;
        std::vector<Mover const*> active;
        for (Mover const& m : movers_) {
            if (m.record.state == ObjectState::static_) still.push_back(&m);
            if (m.record.state == ObjectState::active) active.push_back(&m);
            bool const casts = m.record.state == ObjectState::static_ || m.record.state == ObjectState::active;
            count_.redrawn += casts && cache::may_touch(m.box, volume_) ? 1 : 0;
        }
        clear(kept_.other);
        draw(kept_.other, still);
        bool good = kept_.other == kept_.c;
        draw(kept_.other, active);
        good &= kept_.other == kept_.w;
        count_.wrong += good ? 0 : 1;
    }

    math::Depth depth_;
    Random random_;
    math::dvec3 scene_m_;
    math::dvec3 anchor_m_;
    std::vector<Mover> movers_;
    std::vector<cache::Object> objects_;
    std::vector<OrthoDraw> draws_;
    TileWorkspace workspace_;
    cache::Volume volume_{.x = -32, .y = -32, .z = -codes / 2};
    cache::CachedMap map_;
    KeptMap<T> kept_;
    Count count_;
};

void check_walks(int frames) {
    for (double const far_m : {0.0, 1e4, 1e7})
        for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed}) {
            for (bool const unorm16 : {true, false}) {
                Count const count = unorm16 ? Walk<std::uint16_t>(depth, far_m, 5).run(frames) : Walk<float>(depth, far_m, 6).run(frames);
                CHECK(count.wrong == 0);
                CHECK(adds_up(count.history));
                CHECK(count.history.scrolls > static_cast<std::uint64_t>(frames / 3));
                CHECK(count.drawn * 3 < count.redrawn * 2);
            }
        }
}

}  // namespace

TEST_CASE("maps that are cached and scrolled are the maps drawn from nothing, bit for bit", "[raster][ortho][cache]") {
    check_walks(150);
}

TEST_CASE("ten thousand frames of cached and scrolled maps are the maps drawn from nothing", "[raster][ortho][cache][.full]") {
    check_walks(10000);
}
