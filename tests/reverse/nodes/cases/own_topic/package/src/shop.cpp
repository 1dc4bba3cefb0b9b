#include <own_topic/Order.h>
#include <ros/ros.h>

namespace {

enum class Mood { CALM, BUSY = 4, CLOSED };

own_topic::Order make(int amount) {
  own_topic::Order order;
  order.colour = own_topic::Order::BLUE;
  order.amount = amount;
  order.note = "again";
  order.to.row = 2;
  return order;
}

}  // namespace

class Shop {
 public:
  Shop() : mood_(Mood::CALM) {
    orders_ = nh_.subscribe("orders", 3, &Shop::take, this);
    again_ = nh_.advertise<own_topic::Order>("orders", 3);
  }

 private:
  void take(const own_topic::OrderConstPtr& order) {
    row_ = order->to.row;
    switch (order->colour) {
      case own_topic::Order::RED:
        mood_ = Mood::BUSY;
        break;
      default:
        mood_ = Mood::CALM;
    }
    if (order->amount > 0) {
      again_.publish(make(order->amount - 1));
    }
  }

  ros::NodeHandle nh_;
  ros::Subscriber orders_;
  ros::Publisher again_;
  Mood mood_;
  int row_ = 0;
};

int main(int argc, char** argv) {
  ros::init(argc, argv, "shop");
  Shop shop;
  ros::spin();
}
