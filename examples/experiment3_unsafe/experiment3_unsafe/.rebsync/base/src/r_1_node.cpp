// Copyright 2026 The rebsync authors
//
// Licensed under the Apache License, Version 2.0 (the "License");
// you may not use this file except in compliance with the License.
// You may obtain a copy of the License at
//
//     http://www.apache.org/licenses/LICENSE-2.0
//
// Unless required by applicable law or agreed to in writing, software
// distributed under the License is distributed on an "AS IS" BASIS,
// WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
// See the License for the specific language governing permissions and
// limitations under the License.

#include "experiment3_unsafe/r_1.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "r_1");
  const ros::NodeHandle node("~");
  experiment3_unsafe::R_1 rebec(node);
  ros::AsyncSpinner reception(1);
  reception.start();
  rebec.mailbox().start();
  ros::waitForShutdown();
  rebec.mailbox().stop();
  return 0;
}
