#include "dermis/base/hash.h"

#include <xxhash.h>

#include <cstdio>
#include <new>

namespace dermis::inline base {
namespace {
XXH3_state_t* as_state(void* state) {
    return static_cast<XXH3_state_t*>(state);
}
}  // namespace

Hasher::Hasher() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(as_state(state_));
}
Hasher::~Hasher() {
    XXH3_freeState(as_state(state_));
}

Hasher& Hasher::add(std::span<const std::byte> bytes) {
    const uint64_t size = bytes.size();
    XXH3_128bits_update(as_state(state_), &size, sizeof size);
    XXH3_128bits_update(as_state(state_), bytes.data(), bytes.size());
    return *this;
}

Hasher& Hasher::add(std::string_view text) {
    return add(std::as_bytes(std::span(text.data(), text.size())));
}

std::string Hasher::hex() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(as_state(state_));
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                  static_cast<unsigned long long>(hash.low64));
    return text;
}

}  // namespace dermis::inline base
