// What published formulas say of the wave that a slide makes: a first estimate without a run, a cross-check beside one.
//
// SI units, angles in degrees. Each function names its source, and returns with its value the limits of the tests
// behind it that are broken; a value outside them is an extrapolation. What is only recalled, and was not read again in
// its source, says so: `Formula::verified` is false. Left out are formulas whose coefficients are not certain: the wave
// height in 3-D of the first edition of VAW 254's method, whose 1.5 P^0.8 is an amplitude in one transcription.
#pragma once

#include <string>
#include <vector>

namespace lgiw {

/// A slide where it meets the water, and the water there.
struct SlideImpact {
  double speed = 0;      // Vs, m/s, of the slide at impact
  double thickness = 0;  // s, m, the largest, across the slope
  double width = 0;      // b, m
  double volume = 0;     // V, m3 (2-D: over the width b)
  double density = 0;    // rho_s, kg/m3, of the bulk
  double slope = 0;      // alpha, degrees: angle of impact below the horizontal
  double depth = 0;      // h, m: still water depth before the slide
  double water_density = 1000;
  double gravity = 9.81;
};

/// The dimensionless numbers of Heller & Hager (2010).
struct ImpulseNumbers {
  double froude = 0;            // F = Vs / sqrt(g h), slide Froude number
  double thickness = 0;         // S = s / h
  double mass = 0;              // M = rho_s V / (rho_w b h^2)
  double volume = 0;            // V / (b h^2)
  double width = 0;             // B = b / h
  double density = 0;           // D = rho_s / rho_w
  double effective_cosine = 0;  // cos(6 alpha / 7)
  double impulse_product = 0;   // P = F S^1/2 M^1/4 cos(6 alpha / 7)^1/2
};
ImpulseNumbers impulse_numbers(const SlideImpact& impact);

/// A quantity that lies outside the tests behind a formula. An open end of the range is infinite.
struct BrokenLimit {
  std::string quantity;
  double value = 0, low = 0, high = 0;
};
using BrokenLimits = std::vector<BrokenLimit>;

/// Where a formula comes from.
struct Formula {
  std::string name, source;
  bool verified = true;      // false: recalled, not verified against the source
  bool limits_known = true;  // false: nothing is known here of the tests behind it
};
namespace formulas {
extern const Formula vaw254_channel, vaw254_basin, fritz, huber_hager_channel, huber_hager_basin, mohammed_fritz,
    mueller, evers_boes, synolakis, hall_watts, koerner;
}

struct Estimate {
  double value = 0;
  BrokenLimits broken;
};

/// VAW 254 (Evers et al. 2019; Heller & Hager 2010), 2-D, `x` m along a channel from the impact: H_M = 5/9 P^0.8 h and
/// T_M = 9 P^0.5 (h/g)^0.5 at x_M = 5.5 P^0.5 h; beyond H = 0.75 (P X^-1/3)^0.8 h, T = 9 P^1/4 X^5/16 (h/g)^0.5, X =
/// x/h; crest 0.8 H everywhere, celerity (g (h + crest))^0.5. Nearer than x_M the largest wave is returned. The two
/// fits do not meet at x_M: the source has a step there, of 1.35 5.5^(-4/15) P^(-2/15). Limits: F 0.86-6.83, S
/// 0.09-1.64, M 0.11-10.02, V/(b h^2) 0.05-5.94, B 0.74-3.33, D 0.59-1.72, P 0.17-8.13, slope 30-90 degrees, and for x
/// > x_M X 2.7-59.2. B is not looked at where `per_metre`: the channel has no width then.
struct ChannelWave {
  double height = 0, crest = 0, period = 0, celerity = 0;  // m, m, s, m/s
  bool near = false;                                       // x < x_M
  BrokenLimits broken;
};
ChannelWave vaw254_channel(const SlideImpact& impact, double x, bool per_metre = false);
/// x_M, m.
double vaw254_peak_distance(const SlideImpact& impact);

/// VAW 254 (Evers et al. 2019), 3-D: the first crest, first trough and second crest on the edge of the impact zone,
/// a0c1 = 0.2 P^0.5 B^0.75 c^0.25 h, a0t1 = 0.35 P^0.5 B^0.5 c^0.5 h, a0c2 = 0.14 P^0.25 B^0.25 c^0.25 h, c = cos(6
/// alpha/7), and at `r` m from the impact and `angle` degrees off the slide's axis
///   a = a0 exp(-k (a0/h)^-0.3 (r*/h)^0.5) sech(q angle/90)^(c exp(-0.15 (r*/h)^0.5)),
/// (k, q) = (0.4, 3.2), (0.4, 3.6), (0.1, 3); r* = r - r0(angle), r0 the radius of the impact zone: an ellipse of 2.5
/// (P B c)^0.25 h along the axis and b/2 + 1.5 (P c)^0.25 h across. Celerity of the first crest 0.95 (g (h + a))^0.5.
/// Inside the impact zone a = a0 with r* = 0. Beyond 90 degrees nothing: NaN.
/// Limits: F 0.4-3.4, S 0.15-0.6, M 0.25-1, V/(b h^2) 0.187-0.75, B 0.83-5, P 0.13-2.08, slope 30-90 degrees, r/h 1-16.
struct BasinWave {
  double crest = 0, trough = 0, second_crest = 0;  // m above, below, above still water level; all positive
  double celerity = 0;                             // m/s
  bool near = false;                               // r < r0
  BrokenLimits broken;
};
BasinWave vaw254_basin(const SlideImpact& impact, double r, double angle);
/// On the axis at the edge of the impact zone: a0; no limit of r.
BasinWave vaw254_impact(const SlideImpact& impact);
/// r0(angle), m.
double vaw254_impact_radius(const SlideImpact& impact, double angle);

/// Largest crest in a channel, Fritz et al. (2004): 0.25 F^1.4 S^0.8 h. Slope 45 degrees (within one), F 1-4.8.
/// Recalled.
Estimate fritz_crest(const SlideImpact& impact);

/// Wave height, Huber & Hager (1997), X = x/h or r/h: in a channel 0.88 sin(alpha) D^1/4 (V/(b h^2))^1/2 X^-1/4 h, in a
/// basin 1.76 sin(alpha) cos^2(2 angle/3) D^1/4 (V/(b h^2))^1/2 X^-2/3 h. Slope 28-60 degrees. Recalled.
Estimate huber_hager_channel_height(const SlideImpact& impact, double x);
Estimate huber_hager_basin_height(const SlideImpact& impact, double r, double angle);

/// First crest in a basin, Mohammed & Fritz (2012): 0.31 F^2.1 S^0.6 (r/h)^(-1.2 F^0.25 S^-0.02 B^-0.33) cos(angle) h.
/// Recalled, without its limits.
Estimate mohammed_fritz_crest(const SlideImpact& impact, double r, double angle);

/// A wave before a bank of `slope` degrees, over a still water depth `depth`.
struct BankWave {
  double crest = 0;   // a, m
  double height = 0;  // H, m; NaN: not known
  double length = 0;  // L, m; NaN: not known
  double depth = 0, slope = 0;
};
/// Run-up, Mueller (1995): 1.25 (H/h)^1.25 (H/L)^-0.15 (90/beta)^0.2 h.
Estimate mueller_runup(const BankWave& wave);
/// Run-up, Evers & Boes (2019), without breaking: 2 e exp(0.4 e) (90/beta)^0.2 h, e = a/h 0.007-0.69, bank 10-90
/// degrees. The coefficients are recalled in part.
Estimate evers_boes_runup(const BankWave& wave);
/// Run-up of a solitary wave of height a, Synolakis (1987), without breaking: 2.831 cot(beta)^0.5 (a/h)^1.25 h, a/h <
/// 0.818 cot(beta)^(-10/9).
Estimate synolakis_runup(const BankWave& wave);
/// Run-up of a solitary wave of height a, Hall & Watts (1953): 3.05 tan(beta)^-0.13 (a/h)^(1.15 tan(beta)^0.02) h, bank
/// 12-45 degrees. Recalled.
Estimate hall_watts_runup(const BankWave& wave);

/// Speed of a slide whose centre has sunk by `drop` m down a slope against friction, Koerner (1976), the balance of
/// energy: (2 g drop (1 - tan(friction) cot(slope)))^0.5; 0 where friction holds it. Friction 15-35 degrees.
Estimate koerner_speed(double drop, double slope, double friction_angle, double gravity);

}  // namespace lgiw
