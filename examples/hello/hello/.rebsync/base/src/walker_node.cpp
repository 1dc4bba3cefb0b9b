#include "hello/walker.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "walker");
  const ros::NodeHandle node("~");
  hello::Walker rebec(node);
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
