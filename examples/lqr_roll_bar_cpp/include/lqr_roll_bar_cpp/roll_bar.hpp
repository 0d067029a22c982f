// Active roll bars driven by state feedback: the law of vehicle_roll_sim/control_laws/lqr_roll_bar.py.

#ifndef LQR_ROLL_BAR_CPP__ROLL_BAR_HPP_
#define LQR_ROLL_BAR_CPP__ROLL_BAR_HPP_

#include <algorithm>
#include <array>

namespace lqr_roll_bar_cpp
{

// Gains and bars, in SI units; examples/design_lqr_roll_bar.py computes them.
struct Gains
{
  double lateral_velocity_gain, yaw_rate_gain, roll_gain, roll_rate_gain;
  double front_share, front_track, rear_track, largest_force;
};

// The signals fed back: m/s, rad/s, rad and rad/s.
struct Motion
{
  double v, yaw_rate, roll, roll_rate;
};

// Forces at the corners lf, rf, lr, rr (N), whose roll moment counteracts the motion.
inline std::array<double, 4> forces(const Gains & gains, const Motion & motion)
{
  const double moment = gains.lateral_velocity_gain * motion.v +
    gains.yaw_rate_gain * motion.yaw_rate + gains.roll_gain * motion.roll +
    gains.roll_rate_gain * motion.roll_rate;
  const auto limited = [&gains](double force) {
      return std::max(-gains.largest_force, std::min(gains.largest_force, force));
    };
  const double front = limited(gains.front_share * moment / gains.front_track);
  const double rear = limited((1.0 - gains.front_share) * moment / gains.rear_track);
  return {-front, front, -rear, rear};
}

}  // namespace lqr_roll_bar_cpp

#endif  // LQR_ROLL_BAR_CPP__ROLL_BAR_HPP_
