#pragma once
// Runs of balls from wide lanes: what a stream cuts, packed.

#include <gnomon/cull/detail/stream_avx512.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/scalar.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>

namespace gnomon::lights::detail {

#if GNOMON_CULL_AVX2
GNOMON_WIDE_BEGIN

struct RunSink16 {
    Workspace& work;
    Run* next = nullptr;
    cull::detail::I16 lights[4]{};

    void close() noexcept {
        if (next != nullptr) work.run_count = static_cast<std::size_t>(next - work.runs.data());
    }
    void reserve(std::size_t most) {
        close();
        if (work.runs.size() < work.run_count + most + 16) work.runs.resize(2 * work.runs.size() + most + 16);
        next = work.runs.data() + work.run_count;
    }
    GNOMON_WIDE_INLINE void balls(std::size_t from) noexcept {
        for (std::size_t i = 0; i < 4; ++i) lights[i] = cull::detail::wide_load(work.index.data() + from + 16 * i);
    }
    /// The lights of balls: lower six bits.
    GNOMON_WIDE_INLINE __m512i light_of(__m512i ball) const noexcept {
        __m512i const low = _mm512_permutex2var_epi32(lights[0].v, ball, lights[1].v), high = _mm512_permutex2var_epi32(lights[2].v, ball, lights[3].v);
        return _mm512_mask_mov_epi32(low, _mm512_test_epi32_mask(ball, _mm512_set1_epi32(32)), high);
    }
    GNOMON_WIDE_INLINE void rows(cull::detail::Rows16 const& r) noexcept {
        // The lanes of `some`, in the order in which the unpacking of pairs gives runs 0 to 3, 4 to 7, ...
        __m512i const order = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
        cull::detail::I16 const lanes{_mm512_permutexvar_epi32(order, cull::detail::packed(r.some, cull::detail::lane_numbers()).v)};
        __m512i const row = lookup(r.row, lanes).v, first = lookup(r.first, lanes).v, count = lookup(r.count, lanes).v;
        __m512i const light = light_of(lookup(r.ball, lanes).v);
        __m512i const places = _mm512_unpacklo_epi32(row, first), more_places = _mm512_unpackhi_epi32(row, first);
        __m512i const rest = _mm512_unpacklo_epi32(count, light), more_rest = _mm512_unpackhi_epi32(count, light);
        _mm512_storeu_si512(next, _mm512_unpacklo_epi64(places, rest));
        _mm512_storeu_si512(next + 4, _mm512_unpackhi_epi64(places, rest));
        _mm512_storeu_si512(next + 8, _mm512_unpacklo_epi64(more_places, more_rest));
        _mm512_storeu_si512(next + 12, _mm512_unpackhi_epi64(more_places, more_rest));
        next += std::popcount(static_cast<unsigned>(r.some.v));
    }
};

template <bool perspective, bool small>
GNOMON_WIDE_TARGET void find_ball_runs(cull::RowGrid const& grid, Workspace& work) {
    RunSink16 sink{work};
    cull::detail::visit_stream<perspective, small>(grid, input_of(work), work.count, sink);
    sink.close();
}
inline void find_ball_runs(cull::RowGrid const& grid, Workspace& work) {
    if (!grid.perspective) return find_ball_runs<false, false>(grid, work);
    (cull::detail::has_small_tables(grid) ? find_ball_runs<true, true> : find_ball_runs<true, false>)(grid, work);
}

GNOMON_WIDE_END
#endif

}  // namespace gnomon::lights::detail
