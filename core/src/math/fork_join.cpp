#include "math/fork_join.hpp"

#if defined(__x86_64__) || defined(__i386__) || defined(_M_X64)
#include <emmintrin.h>
#define TENDRIL_HAS_PAUSE
#endif

#include <thread>

namespace tendril::detail {
namespace {

constexpr std::uint64_t loop_number = std::uint64_t{1} << 32;
constexpr std::uint64_t first_part = std::uint64_t{1} << 16;
constexpr std::uint64_t part_mask = first_part - 1;

}  // namespace

void pause(std::uint32_t polls) noexcept {
    constexpr std::uint32_t max_spins = 2000;
    if (polls > max_spins) std::this_thread::yield();
#ifdef TENDRIL_HAS_PAUSE
    else
        _mm_pause();
#endif
}

bool ForkJoin::work(bool from_first) noexcept {
    bool any = false;
    std::uint64_t open = open_.load(std::memory_order_acquire);
    for (;;) {
        const std::uint64_t first = open / first_part & part_mask, end = open & part_mask;
        if (first == end) return any;
        const std::uint64_t less = from_first ? open + first_part : open - 1;
        if (!open_.compare_exchange_weak(open, less, std::memory_order_acquire)) continue;
        part_(context_, static_cast<std::uint32_t>(from_first ? first : end - 1));
        done_.fetch_add(1, std::memory_order_release);
        any = true;
        open = open_.load(std::memory_order_acquire);
    }
}

void ForkJoin::run(TaskFunction part, void* context, std::uint32_t count) noexcept {
    // All parts of the previous loop are done, so no thread reads these.
    part_ = part;
    context_ = context;
    done_.store(0, std::memory_order_relaxed);
    const std::uint64_t before = open_.load(std::memory_order_relaxed) & ~(loop_number - 1);
    open_.store(before + loop_number + count, std::memory_order_release);
    work(true);
    for (std::uint32_t polls = 0; done_.load(std::memory_order_acquire) != count; ++polls) pause(polls);
}

}  // namespace tendril::detail
