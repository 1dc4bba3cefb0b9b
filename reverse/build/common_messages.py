"""The fields of message types that come with ROS, as facts: what a package uses is not in it."""

from __future__ import annotations

_POINT = "x float64, y float64, z float64"
_HEADER = "seq uint32, stamp time, frame_id string"
_PLAIN = {
    **{f"{kind}{bits}": f"{kind.lower()}{bits}" for kind in ("Int", "UInt") for bits in (8, 16)},
    **{f"{kind}{bits}": f"{kind.lower()}{bits}" for kind in ("Int", "UInt") for bits in (32, 64)},
    **{"Bool": "bool", "Byte": "byte", "Char": "uint8", "Float32": "float32"},
    **{"Float64": "float64", "String": "string", "Time": "time", "Duration": "duration"},
}

# By type the fields, `name type`; other messages inside by their types.
COMMON: dict[str, str] = {
    **{f"std_msgs/{name}": f"data {type_}" for name, type_ in _PLAIN.items()},
    "std_msgs/Empty": "",
    "std_msgs/Header": _HEADER,
    "std_msgs/ColorRGBA": "r float32, g float32, b float32, a float32",
    "geometry_msgs/Vector3": _POINT,
    "geometry_msgs/Point": _POINT,
    "geometry_msgs/Point32": "x float32, y float32, z float32",
    "geometry_msgs/Quaternion": f"{_POINT}, w float64",
    "geometry_msgs/Pose": "position geometry_msgs/Point, orientation geometry_msgs/Quaternion",
    "geometry_msgs/Pose2D": "x float64, y float64, theta float64",
    "geometry_msgs/Twist": "linear geometry_msgs/Vector3, angular geometry_msgs/Vector3",
    "geometry_msgs/Accel": "linear geometry_msgs/Vector3, angular geometry_msgs/Vector3",
    "geometry_msgs/Wrench": "force geometry_msgs/Vector3, torque geometry_msgs/Vector3",
    "geometry_msgs/Transform": (
        "translation geometry_msgs/Vector3, rotation geometry_msgs/Quaternion"
    ),
    "geometry_msgs/PointStamped": "header std_msgs/Header, point geometry_msgs/Point",
    "geometry_msgs/Vector3Stamped": "header std_msgs/Header, vector geometry_msgs/Vector3",
    "geometry_msgs/QuaternionStamped": (
        "header std_msgs/Header, quaternion geometry_msgs/Quaternion"
    ),
    "geometry_msgs/PoseStamped": "header std_msgs/Header, pose geometry_msgs/Pose",
    "geometry_msgs/TwistStamped": "header std_msgs/Header, twist geometry_msgs/Twist",
    "geometry_msgs/AccelStamped": "header std_msgs/Header, accel geometry_msgs/Accel",
    "geometry_msgs/WrenchStamped": "header std_msgs/Header, wrench geometry_msgs/Wrench",
    "geometry_msgs/PoseWithCovariance": "pose geometry_msgs/Pose, covariance float64[36]",
    "geometry_msgs/TwistWithCovariance": "twist geometry_msgs/Twist, covariance float64[36]",
    "geometry_msgs/PoseWithCovarianceStamped": (
        "header std_msgs/Header, pose geometry_msgs/PoseWithCovariance"
    ),
    "geometry_msgs/TwistWithCovarianceStamped": (
        "header std_msgs/Header, twist geometry_msgs/TwistWithCovariance"
    ),
    "geometry_msgs/TransformStamped": (
        "header std_msgs/Header, child_frame_id string, transform geometry_msgs/Transform"
    ),
    "nav_msgs/Odometry": (
        "header std_msgs/Header, child_frame_id string,"
        " pose geometry_msgs/PoseWithCovariance, twist geometry_msgs/TwistWithCovariance"
    ),
    "nav_msgs/Path": "header std_msgs/Header, poses geometry_msgs/PoseStamped[]",
    "sensor_msgs/Joy": "header std_msgs/Header, axes float32[], buttons int32[]",
    "sensor_msgs/Range": (
        "header std_msgs/Header, radiation_type uint8, field_of_view float32,"
        " min_range float32, max_range float32, range float32"
    ),
    "sensor_msgs/Temperature": "header std_msgs/Header, temperature float64, variance float64",
    "sensor_msgs/Illuminance": "header std_msgs/Header, illuminance float64, variance float64",
    "sensor_msgs/FluidPressure": (
        "header std_msgs/Header, fluid_pressure float64, variance float64"
    ),
    "sensor_msgs/RelativeHumidity": (
        "header std_msgs/Header, relative_humidity float64, variance float64"
    ),
    "sensor_msgs/LaserScan": (
        "header std_msgs/Header, angle_min float32, angle_max float32, angle_increment float32,"
        " time_increment float32, scan_time float32, range_min float32, range_max float32,"
        " ranges float32[], intensities float32[]"
    ),
    "sensor_msgs/Imu": (
        "header std_msgs/Header, orientation geometry_msgs/Quaternion,"
        " orientation_covariance float64[9], angular_velocity geometry_msgs/Vector3,"
        " angular_velocity_covariance float64[9], linear_acceleration geometry_msgs/Vector3,"
        " linear_acceleration_covariance float64[9]"
    ),
    "sensor_msgs/NavSatStatus": "status int8, service uint16",
    "sensor_msgs/NavSatFix": (
        "header std_msgs/Header, status sensor_msgs/NavSatStatus, latitude float64,"
        " longitude float64, altitude float64, position_covariance float64[9],"
        " position_covariance_type uint8"
    ),
    "sensor_msgs/JointState": (
        "header std_msgs/Header, name string[], position float64[], velocity float64[],"
        " effort float64[]"
    ),
    "sensor_msgs/BatteryState": (
        "header std_msgs/Header, voltage float32, temperature float32, current float32,"
        " charge float32, capacity float32, design_capacity float32, percentage float32,"
        " power_supply_status uint8, power_supply_health uint8, power_supply_technology uint8,"
        " present bool, cell_voltage float32[], cell_temperature float32[], location string,"
        " serial_number string"
    ),
    "actionlib_msgs/GoalID": "stamp time, id string",
    "turtlesim/Pose": (
        "x float32, y float32, theta float32, linear_velocity float32, angular_velocity float32"
    ),
    "turtlesim/Color": "r uint8, g uint8, b uint8",
    "rosgraph_msgs/Clock": "clock time",
    "ackermann_msgs/AckermannDrive": (
        "steering_angle float32, steering_angle_velocity float32, speed float32,"
        " acceleration float32, jerk float32"
    ),
    "ackermann_msgs/AckermannDriveStamped": (
        "header std_msgs/Header, drive ackermann_msgs/AckermannDrive"
    ),
    # What services get and give.
    **dict.fromkeys(("std_srvs/Empty_Request", "std_srvs/Empty_Response"), ""),
    "std_srvs/Trigger_Request": "",
    "std_srvs/SetBool_Request": "data bool",
    **dict.fromkeys(
        ("std_srvs/Trigger_Response", "std_srvs/SetBool_Response"), "success bool, message string"
    ),
    "example_interfaces/AddTwoInts_Request": "a int64, b int64",
    "example_interfaces/AddTwoInts_Response": "sum int64",
}

_ARRAYS = (
    "Byte",
    "Float32",
    "Float64",
    *(f"{k}{n}" for k in ("Int", "UInt") for n in (8, 16, 32, 64)),
)
# All types of those packages that are known whole.
WHOLE: dict[str, frozenset[str]] = {
    "std_msgs": frozenset(
        {*_PLAIN, "Empty", "Header", "ColorRGBA", "MultiArrayDimension", "MultiArrayLayout"}
        | {f"{name}MultiArray" for name in _ARRAYS}
    )
}
