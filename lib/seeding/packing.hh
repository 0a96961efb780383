// Water around bodies that no lattice fits.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace lgiw {

/// A particle for packing: `moves` where it may be shifted.
struct PackedParticle {
  std::array<double, 3> place;
  double volume = 0;
  bool moves = false;
  bool level = false;  // shifted horizontally only: near the free surface, beyond which nothing balances it
};

/// Shifts the particles that move down the gradient of sum V W (Wendland C2, smoothing length 1.5 dp), as particle
/// shifting does (Lind et al., J. Comput. Phys. 231, 2012, 1499-1523), until they fill the space between the others
/// evenly. `keep_out` brings a place back into the space allowed. `dp` in m; two_d: y stays as it is.
void pack(std::vector<PackedParticle>& particles, double dp, bool two_d,
          const std::function<void(std::array<double, 3>&)>& keep_out);

/// Marks the particles that move and, after packing, stand nearer than `distance` to one that does not or to an
/// unmarked one before them.
std::vector<uint8_t> nearer_than(const std::vector<PackedParticle>& particles, double distance);

}  // namespace lgiw
