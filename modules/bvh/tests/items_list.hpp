#pragma once
// Lists of items for the tests: owned arrays, generators, executors of any order.

#include <gnomon/bvh/items.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/touch.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace items_list {

using namespace gnomon;

struct Balls {
    std::vector<float> x, y, z, radius;

    void add(math::Sphere const& s) {
        x.push_back(s.center.x);
        y.push_back(s.center.y);
        z.push_back(s.center.z);
        radius.push_back(s.radius);
    }
    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] math::Sphere at(std::size_t i) const { return {math::vec3(x[i], y[i], z[i]), radius[i]}; }
    [[nodiscard]] bvh::Spheres list() const { return {x, y, z, radius}; }
};

struct Crates {
    std::vector<float> c[6];

    void add(math::Aabb const& box) {
        float const v[6] = {box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z};
        for (std::size_t k = 0; k < 6; ++k) c[k].push_back(v[k]);
    }
    [[nodiscard]] std::size_t size() const { return c[0].size(); }
    [[nodiscard]] math::Aabb at(std::size_t i) const {
        return {math::vec3(c[0][i], c[1][i], c[2][i]), math::vec3(c[3][i], c[4][i], c[5][i])};
    }
    [[nodiscard]] bvh::Boxes list() const { return {c[0], c[1], c[2], c[3], c[4], c[5]}; }
};

inline std::string check_string(Balls const& balls) { return std::to_string(balls.size()) + " spheres"; }

struct Random {
    std::uint64_t state;
    float operator()(float lo, float hi) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return lo + (hi - lo) * (static_cast<float>(state >> 40U) / 16777216.0F);
    }
    math::vec3 point(float lo, float hi) {
        float const a = (*this)(lo, hi);
        float const b = (*this)(lo, hi);
        float const d = (*this)(lo, hi);
        return math::vec3(a, b, d);
    }
};

inline Balls cloud(std::size_t n, std::uint64_t seed = 1) {
    Random random{seed};
    Balls balls;
    for (std::size_t i = 0; i < n; ++i) {
        math::vec3 const p = random.point(-100.0F, 100.0F);
        balls.add({p, random(0.0F, 3.0F)});
    }
    return balls;
}

inline Crates crates_of(Balls const& balls) {
    Crates crates;
    for (std::size_t i = 0; i < balls.size(); ++i) crates.add(math::box_of(balls.at(i)));
    return crates;
}

/// Spheres of every kind: repeated centres, no radius, huge ones, 1e7 m away.
inline auto balls(int least, int most) {
    return [least, most](check::Choices& choices) {
        Balls list;
        int const n = check::integers(least, most)(choices);
        for (int i = 0; i < n; ++i) {
            math::vec3 const p = i > 0 && choices.draw(7) == 7 ? list.at(0).center : math::points()(choices);
            std::uint64_t const kind = choices.draw(7);
            float const r = kind == 0 ? 0.0F : kind == 1 ? 1e6F : check::floats(0.0F, 50.0F)(choices);
            list.add({p, r});
        }
        return list;
    };
}

/// Takes the ranges from the last to the first, each of one item.
struct BackwardExecutor {
    template <class F>
    void parallel_for(std::size_t n, std::size_t /*grain*/, F&& f) const {
        for (std::size_t i = n; i > 0; --i) f(i - 1, i);
    }
};

}  // namespace items_list
