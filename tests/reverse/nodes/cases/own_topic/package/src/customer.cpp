#include <own_topic/Order.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "customer");
  ros::NodeHandle nh;
  ros::Publisher orders = nh.advertise<own_topic::Order>("orders", 1);
  own_topic::Order order;
  order.colour = own_topic::Order::RED;
  order.amount = 2;
  orders.publish(order);
  ros::spin();
}
