// Objects behind handles. A handle is the index of a slot and a generation, which is odd while the slot is in
// use.
//
// C code can use a handle after its object was destroyed, from two threads, or with invented contents. Each
// call therefore checks the slot, which always exists, so none of these crashes. This table is the library's
// only global state, because handles are plain values. Taking and returning an object costs two atomic
// operations, about 10 ns.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "call.hpp"

namespace tendril::door {

inline constexpr std::uint32_t most_objects =
    65'536;  // per kind: 16 bytes each of memory that is zero until used
inline std::atomic<std::size_t> live_objects{0};

template <class Object>
class Slots {
  public:
    /// Takes ownership of an object and returns its index and generation. False if all slots are in use.
    bool add(std::unique_ptr<Object> object, std::uint32_t& index, std::uint32_t& generation) noexcept {
        const std::lock_guard lock(mutex_);
        if (free_ == 0 && used_ == most_objects) return false;
        index = free_ > 0 ? free_ - 1 : used_++;
        Slot& slot = slots_[index];
        if (free_ > 0) free_ = slot.next_free;
        slot.object = object.release();
        generation = (slot.word.load(std::memory_order_relaxed) >> 1) + 1;
        slot.word.store(generation << 1, std::memory_order_release);
        ++live_objects;
        return true;
    }
    /// The object, for this call alone, until give_back(). Null, with a refusal, if there is none or another
    /// thread is using it.
    Object* take(Call& call, const Place& place, std::uint32_t index, std::uint32_t generation) noexcept {
        const bool odd = generation % 2 == 1 && generation < 1u << 31;
        std::uint32_t word = generation << 1;
        if (index < most_objects && odd &&
            slots_[index].word.compare_exchange_strong(word, word | busy, std::memory_order_acquire))
            return slots_[index].object;
        if (index < most_objects && odd && word == (generation << 1 | busy))
            call.refuse(TENDRIL_BUSY, place, "is in use by another thread");
        else
            call.refuse(TENDRIL_STALE_HANDLE, place, "was destroyed, or never made");
        return nullptr;
    }
    void give_back(std::uint32_t index) noexcept {
        slots_[index].word.fetch_and(~busy, std::memory_order_release);
    }
    /// Destroys an object that this call has taken.
    void remove(std::uint32_t index) noexcept {
        Slot& slot = slots_[index];
        delete slot.object;
        const std::lock_guard lock(mutex_);
        slot.word.store(((slot.word.load(std::memory_order_relaxed) >> 1) + 1) << 1,
                        std::memory_order_release);
        slot.next_free = free_;
        free_ = index + 1;
        --live_objects;
    }

  private:
    static constexpr std::uint32_t busy = 1;
    struct Slot {
        std::atomic<std::uint32_t> word{0};  // generation * 2 + busy
        std::uint32_t next_free = 0;         // index + 1
        Object* object = nullptr;
    };
    Slot slots_[most_objects];
    std::mutex mutex_;
    std::uint32_t free_ = 0, used_ = 0;
};

/// One table per kind of object.
template <class Object>
inline constinit Slots<Object> slots;

/// An object and the memory that its calls need, so that they allocate nothing after the first.
template <class Cpp, class Scratch>
struct Held {
    Cpp object;
    Scratch scratch{};
};

/// Takes an object for the duration of one call.
template <class Cpp, class Scratch>
class Taken {
  public:
    template <class C>
    Taken(Call& call, const Place& place, C handle) noexcept
        : index_(handle.index),
          held_(slots<Held<Cpp, Scratch>>.take(call, place, handle.index, handle.generation)) {}
    ~Taken() {
        if (held_ != nullptr) slots<Held<Cpp, Scratch>>.give_back(index_);
    }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

    /// Requires that the call is not refused.
    Cpp& operator*() const noexcept { return held_->object; }
    Scratch& scratch_or(Scratch& other) const noexcept { return held_ != nullptr ? held_->scratch : other; }
    void destroy() noexcept {
        if (held_ != nullptr) slots<Held<Cpp, Scratch>>.remove(index_);
        held_ = nullptr;
    }

  private:
    std::uint32_t index_;
    Held<Cpp, Scratch>* held_;
};

/// Writes a new object's handle, or notes why it was not made.
template <class Scratch, class Cpp, class C>
void make(Call& call, C* out, Expected<Cpp> made) {
    if (!made) return call.refuse(made.error());
    auto held = std::make_unique<Held<Cpp, Scratch>>(Held<Cpp, Scratch>{std::move(*made)});
    if (!slots<Held<Cpp, Scratch>>.add(std::move(held), out->index, out->generation))
        call.refuse(TENDRIL_NO_MEMORY, {"out"}, "would be more than %u objects of its kind", most_objects);
}

}  // namespace tendril::door
