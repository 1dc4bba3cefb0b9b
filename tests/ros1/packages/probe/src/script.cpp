#include "probe/script.h"

#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "probe/ScriptState.h"

namespace probe {

namespace {

constexpr Server kPlain{"plain", kNoPriority};
constexpr Server kLow{"low", 2};
constexpr Server kHigh{"high", 1};

const Server& serverOf(const std::string& name) {
  if (name == kLow.name) return kLow;
  return name == kHigh.name ? kHigh : kPlain;
}

}  // namespace

Script::Script(const ros::NodeHandle& node)
    : node_(node),
      mailbox_(node, static_cast<std::size_t>(node.param("capacity", 20)), kHigh.priority),
      drive_(node, mailbox_),
      sensor_(node, "sensor") {
  state_ = node_.advertise<ScriptState>("state", 100, true);
  const auto peers = node_.param("peers", std::vector<std::string>());
  for (const std::string server : {"plain", "low", "high"}) {
    for (const auto& peer : peers) {
      publishers_[server][peer] = mailbox_.advertise<Note>(peer + "/" + server);
    }
  }
  subscribers_ = {mailbox_.subscribe("plain", &Script::receivePlain, this),
                  mailbox_.subscribe("low", &Script::receiveLow, this),
                  mailbox_.subscribe("high", &Script::receiveHigh, this)};
  for (const std::string server : {"constructor", "plain", "low", "high"}) {
    scripts_[server] = node_.param("script/" + server, std::vector<std::string>());
  }
  mailbox_.onServed([this](const Served& served) { publishState(served); });
  mailbox_.construct([this] { run("constructor", 0); });
}

void Script::run(const std::string& server, int32_t value) {
  value_ = value;
  for (const auto& line : scripts_[server]) step(line);
}

void Script::step(const std::string& line) {
  std::istringstream words(line);
  std::string verb;
  int32_t x = 0;
  int32_t y = 0;
  words >> verb;
  if (verb == "send") return send(words);
  if (verb == "raw") return sendUnstamped(words);
  words >> x >> y;
  if (verb == "delay") mailbox_.delay(x);
  if (verb == "move") drive_.move(x, y);
  if (verb == "index") std::array<int32_t, 2>().at(static_cast<std::size_t>(x));
  if (verb == "divide") notes_.push_back(divide(x, y));
  if (verb == "assert") mailbox_.assertion(x != 0, "x is not 0");
  if (verb == "choose") notes_.push_back(mailbox_.choose({1, 2, 3, 4, 5, 6, 7}));
  if (verb == "now") notes_.push_back(mailbox_.now());
  if (verb == "is_script") notes_.push_back(mailbox_.isA(mailbox_.sender(), "Script"));
  if (verb == "value") notes_.push_back(value_);
  if (verb == "sense") sensed();
  if (verb == "kill") std::raise(SIGKILL);
  if (verb == "interrupt") ::kill(::getpid(), SIGINT);
  if (verb == "hang") std::this_thread::sleep_for(std::chrono::seconds(x));
  if (verb == "quit") std::_Exit(1);
  if (verb == "throw") throw std::runtime_error("of the user's code");
}

// send <rebec> <server> <value> [after <t>] [deadline <t>]
void Script::send(std::istringstream& words) {
  std::string rebec;
  std::string name;
  int32_t value = 0;
  words >> rebec >> name >> value;
  When when;
  std::string verb;
  for (int32_t time = 0; words >> verb >> time;) {
    verb == "after" ? when.after(time) : when.deadline(time);
  }
  if (rebec == "self") {
    mailbox_.post(serverOf(name), when, text(value), [this, name, value] { run(name, value); });
    return;
  }
  Note msg;
  msg.sender = mailbox_.self();
  msg.value = value;
  mailbox_.publish(to(publishers_[name], rebec == "sender" ? mailbox_.sender() : rebec), msg, when);
}

// raw <rebec> <server> <value>: as somebody sends it who is no rebec
void Script::sendUnstamped(std::istringstream& words) {
  std::string rebec;
  std::string name;
  Note msg;
  words >> rebec >> name >> msg.value;
  to(publishers_[name], rebec).publish(msg);
}

void Script::sensed() {
  const auto seen = sensor_.seen([](const Note& note) { return note.value; });
  notes_.push_back(seen.value_or(-1));
  notes_.push_back(mailbox_.choose({4, 5}, seen));
}

void Script::receivePlain(const Note::ConstPtr& msg) { receive(kPlain, msg); }
void Script::receiveLow(const Note::ConstPtr& msg) { receive(kLow, msg); }
void Script::receiveHigh(const Note::ConstPtr& msg) { receive(kHigh, msg); }

void Script::receive(const Server& server, const Note::ConstPtr& msg) {
  mailbox_.receive(server, msg->timing, msg->sender, text(msg->value),
                   [this, server, msg] { run(server.name, msg->value); });
}

void Script::publishState(const Served& served) {
  ScriptState msg;
  msg.server = served.server;
  msg.arguments = served.arguments;
  msg.arrival = served.arrival;
  msg.start = served.start;
  msg.now = served.now;
  msg.sender = mailbox_.sender();
  msg.expiry = mailbox_.expiry();
  msg.waiting = mailbox_.waitingTime();
  msg.notes = notes_;
  state_.publish(msg);
}

}  // namespace probe
