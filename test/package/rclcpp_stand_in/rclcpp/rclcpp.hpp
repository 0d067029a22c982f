// A stand-in for rclcpp, which the wheels of ROS 2 lack: declarations, with the names and types of
// rclcpp, of what examples/lqr_roll_bar_cpp calls. A compiler checks calls against it; nothing links.

#ifndef RCLCPP__RCLCPP_HPP_
#define RCLCPP__RCLCPP_HPP_

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rclcpp
{

template<typename MessageT>
class Publisher
{
public:
  using SharedPtr = std::shared_ptr<Publisher>;
  void publish(const MessageT & message);
};

template<typename MessageT>
class Subscription
{
public:
  using SharedPtr = std::shared_ptr<Subscription>;
};

class Parameter {};

class Node : public std::enable_shared_from_this<Node>
{
public:
  using SharedPtr = std::shared_ptr<Node>;
  explicit Node(const std::string & node_name);
  template<typename ParameterT>
  ParameterT declare_parameter(const std::string & name);
  template<typename ParameterT>
  ParameterT declare_parameter(const std::string & name, const ParameterT & default_value);
  template<typename MessageT>
  typename Subscription<MessageT>::SharedPtr create_subscription(
    const std::string & topic_name, size_t depth, std::function<void(const MessageT &)> callback);
  template<typename MessageT>
  typename Publisher<MessageT>::SharedPtr create_publisher(
    const std::string & topic_name, size_t depth);
  size_t count_subscribers(const std::string & topic_name) const;
};

class SyncParametersClient
{
public:
  SyncParametersClient(Node::SharedPtr node, const std::string & remote_node_name);
  bool service_is_ready() const;
  std::vector<Parameter> get_parameters(
    const std::vector<std::string> & names, std::chrono::nanoseconds timeout);
};

void init(int argc, char const * const * argv);
bool ok();
bool sleep_for(const std::chrono::nanoseconds & nanoseconds);
void spin(Node::SharedPtr node);
bool shutdown();

}  // namespace rclcpp

#endif  // RCLCPP__RCLCPP_HPP_
