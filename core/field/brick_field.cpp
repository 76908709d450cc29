#include "core/field/brick_field.h"

#include "core/field/cut_ends.h"

#include <algorithm>

namespace ramus::field {

void Projection::grow(std::size_t capacity) {
    for (auto* array : {&x, &y, &z, &cx, &cy, &cz, &reach}) array->resize(capacity);
}

void Projection::pad() {
    const std::size_t padded = size_ + kProjectionPadding;
    if (x.size() < padded) grow(padded);
    for (auto* array : {&x, &y, &z, &cx, &cy, &cz, &reach})
        std::fill_n(array->begin() + static_cast<std::ptrdiff_t>(size_), kProjectionPadding, (*array)[size_ - 1]);
}

std::uint64_t BrickField::find_owners(const LatticeAxes& /*lattice*/, std::span<const LatticePoint> /*points*/,
                                      std::span<Owner> owners) {
    std::ranges::fill(owners, kNoOwner);
    return 0;
}

int BrickField::piece_of(Owner /*owner*/) const { return -1; }

bool BrickField::apart_pieces(int /*a*/, int /*b*/) const { return false; }

bool BrickField::beside_contact(const glm::vec3& /*at*/) { return false; }

DrawnPoint BrickField::draw(const OwnedGuess& /*whose*/, const glm::vec3& guess, float /*onward*/) { return {guess}; }

std::uint64_t BrickField::project_apart(const Projection& /*guesses*/, std::span<const OwnedGuess> /*owned*/,
                                        const SurfacePoints& /*to*/) {
    return 0;
}

void BrickField::flatten(const SurfacePoints& points, std::size_t count) const {
    if (cut_ends_ != nullptr) flatten_ends(*cut_ends_, points, count);
}

} // namespace ramus::field
