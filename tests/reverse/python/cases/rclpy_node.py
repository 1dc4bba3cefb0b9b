# What rclpy offers: nodes by inheritance and by functions, profiles, parameters, timers.
import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSDurabilityPolicy, QoSPresetProfiles, QoSProfile, qos_profile_sensor_data
from std_msgs.msg import Int32, String


class Talker(Node):
    def __init__(self, name="talker", **more):
        super().__init__(name, **more)  #= node "talker" | "second"
        self.declare_parameter("period", 0.5)  #= parameter declare "period" = 0.5
        self.declare_parameters("arm", [("left", 1), ("right", 2)])  #= parameter declare "arm.left" = 1 //= parameter declare "arm.right" = 2
        period = self.get_parameter("period").value  #= parameter get "period"
        text = self.get_parameter("period").get_parameter_value().string_value  #= parameter get "period"
        other = self.get_parameter_or("other", 3)  #= parameter get "other" = 3
        self.set_parameters([Parameter("period", Parameter.Type.DOUBLE, 2.0)])  #= parameter set "period" := 2.0
        self.set_parameters_atomically([Parameter("period", value=3.0)])  #= parameter set "period" := 3.0
        self.get_parameters(["one", "two"])  #= parameter get "one" //= parameter get "two"
        self.get_parameters(names)  #= parameter get ?
        self.get_parameters_by_prefix("arm")  #= parameter get ? "arm.*"
        self.timer = self.create_timer(period, self.tick)  #= timer {"period" = 0.5} -> Talker.tick
        latched = QoSProfile(depth=1, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL)
        self.pub = self.create_publisher(String, "chatter", latched)  #= publisher "chatter" "std_msgs/String" 1 latched=true
        later = QoSProfile(depth=3)
        later.depth = 8
        self.create_publisher(String, "later", later)  #= publisher "later" "std_msgs/String" 8
        self.create_subscription(Int32, "in", self.heard, qos_profile_sensor_data)  #= subscription "in" "std_msgs/Int32" 5 -> Talker.heard
        self.create_subscription(Int32, "n", self.heard, QoSPresetProfiles.PARAMETERS.value)  #= subscription "n" "std_msgs/Int32" 1000 -> Talker.heard
        self.create_subscription(msg_type=Int32, topic="k", callback=lambda m: None, qos_profile=2)  #= subscription "k" "std_msgs/Int32" 2 -> lambda
        self.create_service(AddTwoInts, "~/add", self.add)  #= service "~add" "example_interfaces/AddTwoInts" -> Talker.add
        self.client = self.create_client(AddTwoInts, "/sum")  #= client "/sum" "example_interfaces/AddTwoInts"
        self.rate = self.create_rate(10)  #= rate 10

    def heard(self, msg):
        pass

    def add(self, request, response):
        return response

    def tick(self):
        self.pub.publish(String())


class Louder(Talker):
    def __init__(self):
        super().__init__("second")


def main():
    rclpy.init()
    node = rclpy.create_node("plain")  #= node "plain"

    def inner():
        pass

    node.create_timer(1.0, inner)  #= timer 1.0 -> inner
    rclpy.spin(Talker())
    rclpy.spin(Louder())
