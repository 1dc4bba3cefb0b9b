// The model patrol.rebeca as tables, for the monitor.
#ifndef PATROL_MONITOR_MODEL_H
#define PATROL_MONITOR_MODEL_H

#include <cstdint>

#include "patrol/monitor_machine.h"

namespace patrol {
namespace monitoring {

inline Model theModel() {
  Model model;
  model.name = "patrol.rebeca";
  model.code = {
      {Op::kKnown, 0, 0, {}},
      {Op::kVar, 0, 0, {}},
      {Op::kConst, 3, 0, {}},
      {Op::kMod, 0, 0, {}},
      {Op::kConst, 0, 0, {}},
      {Op::kConst, 3, 0, {}},
      {Op::kSendby, 0, 1, {}},
      {Op::kSelf, 0, 0, {}},
      {Op::kConst, 4, 0, {}},
      {Op::kSend, 1, 0, {}},
      {Op::kRet, 0, 0, {}},
      {Op::kVar, 0, 0, {}},
      {Op::kConst, 1, 0, {}},
      {Op::kAdd, 0, 0, {}},
      {Op::kSetvar, 0, 0, {}},
      {Op::kLocal, 0, 0, {}},
      {Op::kConst, 2, 0, {}},
      {Op::kMod, 0, 0, {}},
      {Op::kOffset, 2, 1, {}},
      {Op::kChoice, 5, 0, {1, 0}},
      {Op::kSetvarat, 1, 0, {}},
      {Op::kRet, 0, 0, {}},
      {Op::kConst, 2, 0, {}},
      {Op::kDelay, 0, 0, {}},
      {Op::kLocal, 0, 0, {}},
      {Op::kSetvar, 0, 0, {}},
      {Op::kSender, 0, 0, {}},
      {Op::kSetvar, 1, 0, {}},
      {Op::kKnown, 0, 0, {}},
      {Op::kVar, 0, 0, {}},
      {Op::kConst, 0, 0, {}},
      {Op::kSend, 2, 1, {}},
      {Op::kRet, 0, 0, {}},
      {Op::kConst, 0, 0, {}},
      {Op::kSetvar, 0, 0, {}},
      {Op::kSelf, 0, 0, {}},
      {Op::kConst, 0, 0, {}},
      {Op::kSend, 1, 0, {}},
      {Op::kRet, 0, 0, {}},
      {Op::kConst, 0, 0, {}},
      {Op::kSetvar, 0, 0, {}},
      {Op::kRet, 0, 0, {}},
  };
  model.texts = {
  };
  model.bodies = {
      {0, 0, 0},  // Station.call
      {11, 1, 1},  // Station.arrived
      {22, 1, 1},  // Cart.drive
      {33, 0, 0},  // Station.Station
      {39, 0, 0},  // Cart.Cart
  };
  model.servers = {
      {"call", 0, 2147483647, false, {}},
      {"arrived", 1, 2147483647, false, {{"place", Kind::kInt, {}}}},
      {"drive", 2, 2147483647, true, {{"place", Kind::kInt, {}}}},
  };
  model.rebecs = {
      {"station", "station", 0, 4, 2147483647, {1},
          {{"seen", Kind::kInt, {}}, {"flags", Kind::kBoolean, {2}}}, 3, {},
          {-1, 0, 1}},
      {"cart", "cart", 1, 3, 2147483647, {0},
          {{"at", Kind::kInt, {}}, {"last", Kind::kRebec, {}}}, 4, {},
          {2, -1, -1}},
  };
  model.global_ranks = false;
  return model;
}

}  // namespace monitoring
}  // namespace patrol

#endif  // PATROL_MONITOR_MODEL_H
