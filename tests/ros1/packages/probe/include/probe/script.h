// A rebec whose bodies are scripts from the parameter server.
#ifndef PROBE_SCRIPT_H
#define PROBE_SCRIPT_H

#include <ros/ros.h>

#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "probe/Note.h"
#include "probe/drive.h"
#include "probe/mailbox.h"
#include "probe/sensor.h"

namespace probe {

class Script {
 public:
  explicit Script(const ros::NodeHandle& node);

  void start() { mailbox_.start(); }
  void stop() { mailbox_.stop(); }

 private:
  void run(const std::string& server, int32_t value);
  void step(const std::string& line);
  void send(std::istringstream& words);
  void sendUnstamped(std::istringstream& words);
  void sensed();

  void receivePlain(const Note::ConstPtr& msg);
  void receiveLow(const Note::ConstPtr& msg);
  void receiveHigh(const Note::ConstPtr& msg);
  void receive(const Server& server, const Note::ConstPtr& msg);
  void publishState(const Served& served);

  ros::NodeHandle node_;
  Mailbox mailbox_;
  Drive drive_;
  Sensor<Note> sensor_;

  std::map<std::string, std::vector<std::string>> scripts_;
  int32_t value_ = 0;
  std::vector<int32_t> notes_;

  ros::Publisher state_;
  std::map<std::string, Publishers> publishers_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace probe

#endif  // PROBE_SCRIPT_H
