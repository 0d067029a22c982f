// The controller lqr_roll_bar in C++: answers every message on `motion` with `normal_force_cmd`.
//
// It shows what any controller has to do in lockstep: answer every set once, with the default
// quality of service, and create its publisher last, when the simulator has found its subscription.

#include <chrono>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "lqr_roll_bar_cpp/roll_bar.hpp"
#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/float64_multi_array.hpp"

using std_msgs::msg::Float64MultiArray;
using namespace std::chrono_literals;

namespace
{

// The element of a labelled array with this name.
double value_of(const Float64MultiArray & message, const std::string & name)
{
  for (size_t i = 0; i < message.layout.dim.size(); ++i) {
    if (message.layout.dim[i].label == name) {
      return message.data.at(i);
    }
  }
  throw std::runtime_error("no " + name + " in the message");
}

}  // namespace

class LqrRollBar : public rclcpp::Node
{
public:
  LqrRollBar()
  : Node("lqr_roll_bar")
  {
    simulator_ = declare_parameter<std::string>("simulator", "simulator");
    // Parameters without a default: the file that design_lqr_roll_bar.py writes gives them.
    gains_ = {
      declare_parameter<double>("lateral_velocity_gain"),
      declare_parameter<double>("yaw_rate_gain"),
      declare_parameter<double>("roll_gain"),
      declare_parameter<double>("roll_rate_gain"),
      declare_parameter<double>("front_share"),
      declare_parameter<double>("front_track"),
      declare_parameter<double>("rear_track"),
      declare_parameter<double>("largest_force"),
    };
    motion_ = create_subscription<Float64MultiArray>(
      "motion", 10, [this](const Float64MultiArray & message) {answer(message);});
  }

  // Wait until the simulator has answered a request: by then it has found the subscription too.
  // The publisher comes last, as lockstep begins as soon as every command has one.
  void connect()
  {
    rclcpp::SyncParametersClient simulator(shared_from_this(), simulator_);
    while (rclcpp::ok()) {
      if (count_subscribers("normal_force_cmd") > 0 && simulator.service_is_ready() &&
        !simulator.get_parameters({"mode"}, 1s).empty())
      {
        forces_ = create_publisher<Float64MultiArray>("normal_force_cmd", 10);
        return;
      }
      rclcpp::sleep_for(20ms);
    }
  }

private:
  void answer(const Float64MultiArray & message)
  {
    if (!forces_) {
      return;
    }
    const lqr_roll_bar_cpp::Motion motion{
      value_of(message, "v"), value_of(message, "yaw_rate"), value_of(message, "roll"),
      value_of(message, "roll_rate")};
    const auto forces = lqr_roll_bar_cpp::forces(gains_, motion);
    Float64MultiArray command;
    command.data.assign(forces.begin(), forces.end());
    forces_->publish(command);
  }

  std::string simulator_;
  lqr_roll_bar_cpp::Gains gains_;
  rclcpp::Subscription<Float64MultiArray>::SharedPtr motion_;
  rclcpp::Publisher<Float64MultiArray>::SharedPtr forces_;
};

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  try {
    const auto node = std::make_shared<LqrRollBar>();
    node->connect();
    rclcpp::spin(node);
  } catch (const std::exception & error) {  // such as a gain that no file gives
    std::cerr << "lqr_roll_bar: error: " << error.what() << '\n';
    return 2;
  }
  rclcpp::shutdown();
  return 0;
}
