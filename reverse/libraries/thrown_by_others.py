"""What functions throw of the libraries that nodes use, for wrong texts, missing files or frames.

Each is what the documentation of the library says. What no table has of a library that was not
looked through may throw as well; `_QUIET` is what does not, of such libraries.
"""

from __future__ import annotations

from rebsync.reverse.libraries.outcome_rules import OutcomeRule, Raises

_QUIET = (
    OutcomeRule("nlohmann::json nlohmann::ordered_json YAML::Node Json::Value"),
    OutcomeRule(
        "nlohmann::json.size nlohmann::json.empty nlohmann::json.find nlohmann::json.count"
    ),
    OutcomeRule("lock try_lock binary_semaphore counting_semaphore latch barrier"),
    OutcomeRule("std::binary_semaphore.release std::counting_semaphore.release"),
    OutcomeRule("nlohmann::json.contains nlohmann::json.is_null nlohmann::json.is_object"),
    OutcomeRule("nlohmann::json.is_number nlohmann::json.is_string nlohmann::json.is_array"),
    OutcomeRule("YAML::Node.IsDefined YAML::Node.IsNull YAML::Node.IsMap YAML::Node.IsSequence"),
    OutcomeRule(
        "cv::Mat cv::Point cv::Point2f cv::Point2d cv::Point3f cv::Size cv::Rect cv::Scalar"
    ),
    OutcomeRule(
        "cv::Vec3b cv::Vec3f cv::Mat.empty cv::Mat.data cv::Mat.rows cv::Mat.cols cv::KeyPoint"
    ),
    OutcomeRule("image_geometry::PinholeCameraModel image_geometry::PinholeCameraModel.fx"),
    OutcomeRule("image_geometry::PinholeCameraModel.fy image_geometry::PinholeCameraModel.cx"),
    OutcomeRule("image_geometry::PinholeCameraModel.cy image_geometry::PinholeCameraModel.Tx"),
    OutcomeRule("image_geometry::PinholeCameraModel.Ty cv_bridge::CvImage.toImageMsg"),
    OutcomeRule(
        "bind std::filesystem::path.stem std::filesystem::path.string "
        "std::filesystem::path.filename"
    ),
    OutcomeRule(
        "std::filesystem::path.extension std::filesystem::path.parent_path "
        "std::filesystem::path.u8string"
    ),
    OutcomeRule(
        "std::filesystem::path.operator/ std::filesystem::path.empty "
        "std::filesystem::path.has_filename"
    ),
    OutcomeRule("cv_bridge::CvImage cv_bridge::CvImagePtr cv_bridge::CvImageConstPtr"),
    OutcomeRule(
        "boost::bind boost::mutex boost::recursive_mutex boost::shared_mutex boost::noncopyable"
    ),
    OutcomeRule(
        "boost::mutex::scoped_lock boost::recursive_mutex::scoped_lock boost::thread.interrupt"
    ),
    OutcomeRule(
        "std::thread.joinable std::thread.detach std::thread.get_id std::mutex.lock_shared"
    ),
    OutcomeRule("boost::posix_time::microsec_clock::local_time boost::posix_time::milliseconds"),
    OutcomeRule(
        "placeholders::_1 placeholders::_2 placeholders::_3 not_fn identity source_location"
    ),
    OutcomeRule(
        "error_code make_error_code weak_ptr enable_shared_from_this chrono::milliseconds::max"
    ),
    OutcomeRule("chrono::time_point_cast chrono::hours chrono::steady_clock chrono::system_clock"),
    OutcomeRule(
        "filesystem::path vector::from_range ios_base ios::app ios::in ios::out ios::binary"
    ),
    OutcomeRule(
        "filesystem::is_regular_file filesystem::is_directory filesystem::temp_directory_path"
    ),
    OutcomeRule(
        "variant monostate any complex real imag arg norm conj polar declval bad_cast hypotf"
    ),
    OutcomeRule(
        "nth_element max_align_t ptrdiff_t put_time get_time localtime gmtime mktime strftime"
    ),
    OutcomeRule(
        "left right scientific defaultfloat showpoint noshowpoint ws uppercase ends skipws"
    ),
    OutcomeRule("fminf fmaxf sinf cosf atan2f powf floorf ceilf expf logf log10f fmodf roundf"),
    OutcomeRule("memory_order_relaxed memory_order_acquire memory_order_release defer_lock"),
    OutcomeRule(
        "adopt_lock try_to_lock make_move_iterator inserter front_inserter piecewise_construct"
    ),
    OutcomeRule(
        "unique_copy remove_copy_if transform_reduce exclusive_scan inclusive_scan tie ignore"
    ),
    OutcomeRule(
        "initializer_list::begin initializer_list::end string::npos nothrow launder as_bytes"
    ),
    OutcomeRule(
        "bernoulli_distribution discrete_distribution poisson_distribution mt19937_64 seed_seq"
    ),
    OutcomeRule(
        "uncaught_exceptions current_exception make_exception_ptr nested_exception bit_cast"
    ),
    OutcomeRule(
        'bitset.test std::random_device.entropy literals::operator""s literals::operator""ms'
    ),
    OutcomeRule('literals::operator""us literals::operator""ns literals::operator""h'),
    OutcomeRule('literals::operator""min literals::operator""sv'),
)
THROWN = (
    OutcomeRule("rethrow_exception throw_with_nested rethrow_if_nested", raises="an exception"),
    OutcomeRule(
        "filesystem::file_size filesystem::copy filesystem::copy_file filesystem::rename "
        "filesystem::create_directory filesystem::create_directories filesystem::remove "
        "filesystem::remove_all filesystem::canonical filesystem::last_write_time "
        "filesystem::directory_iterator filesystem::recursive_directory_iterator "
        "filesystem::resize_file filesystem::space filesystem::create_symlink",
        raises="std::filesystem::filesystem_error",
        when=Raises.NO_ERROR_CODE,
    ),
    OutcomeRule(
        "ros::NodeHandle ros::names::resolve ros::names::append ros::names::remap",
        raises="ros::InvalidNameException",
        acts="nothing is known of it",
        when=Raises.NO_NAME,
    ),
    OutcomeRule("boost::lexical_cast", raises="boost::bad_lexical_cast"),
    OutcomeRule("boost::numeric_cast", raises="boost::numeric::bad_numeric_cast"),
    OutcomeRule("boost::any_cast", raises="boost::bad_any_cast"),
    OutcomeRule("boost::get", raises="boost::bad_get"),
    OutcomeRule(
        "YAML::Load YAML::LoadFile YAML::LoadAll YAML::LoadAllFromFile YAML::Node.Scalar",
        raises="YAML::Exception",
    ),
    OutcomeRule("YAML::Node.as", raises="YAML::Exception", when=Raises.ALONE),
    OutcomeRule(
        "nlohmann::json::parse nlohmann::json.get nlohmann::json.at nlohmann::json.value "
        "nlohmann::json.get_to nlohmann::json.dump",
        raises="nlohmann::json::exception",
    ),
    OutcomeRule(
        "Json::Value.asInt Json::Value.asUInt Json::Value.asDouble Json::Value.asString "
        "Json::Value.asBool",
        raises="Json::LogicError",
    ),
    OutcomeRule(
        "boost::property_tree::ptree.get boost::property_tree::ptree.get_value",
        raises="boost::property_tree::ptree_error",
        when=Raises.NO_DEFAULT,
    ),
    OutcomeRule(
        "boost::property_tree::ptree.get_child", raises="boost::property_tree::ptree_error"
    ),
    OutcomeRule("fmt::format", raises="fmt::format_error"),
    OutcomeRule(
        ".lookupTransform .lookupTransformFull .lookupTwist .transformPose .transformPoint "
        ".transformVector .transformQuaternion .transformPointCloud tf2_ros::Buffer.transform "
        "tf2_ros::Buffer.lookupTransform tf2_ros::BufferInterface.lookupTransform "
        "tf2_ros::BufferInterface.transform tf2::BufferCore.lookupTransform "
        "tf::TransformListener.lookupTransform tf::TransformListener.transformPose "
        "tf::TransformListener.transformPoint tf::TransformListener.transformVector "
        "tf::TransformListener.transformQuaternion tf::TransformListener.lookupTwist",
        raises="tf2::TransformException",
    ),
    OutcomeRule("cv_bridge::toCvCopy cv_bridge::toCvShare", raises="cv_bridge::Exception"),
    OutcomeRule("cv_bridge::cvtColor", raises="cv_bridge::Exception"),
    OutcomeRule(
        ".createSharedInstance .createUniqueInstance .createUnmanagedInstance .createInstance "
        "pluginlib::ClassLoader.createSharedInstance pluginlib::ClassLoader.createUniqueInstance "
        "pluginlib::ClassLoader.createUnmanagedInstance pluginlib::ClassLoader.createInstance",
        raises="pluginlib::PluginlibException",
    ),
    OutcomeRule(
        "sensor_msgs::PointCloud2Iterator sensor_msgs::PointCloud2ConstIterator "
        "sensor_msgs::image_encodings::bitDepth sensor_msgs::image_encodings::numChannels",
        raises="std::runtime_error",
    ),
    OutcomeRule(
        "get_parameter .get_parameter rclcpp::Node.get_parameter "
        "rclcpp_lifecycle::LifecycleNode.get_parameter",
        raises="rclcpp::exceptions::ParameterNotDeclaredException",
        when=Raises.UNDECLARED_ALONE,
    ),
    OutcomeRule(
        "declare_parameter .declare_parameter rclcpp::Node.declare_parameter "
        "rclcpp_lifecycle::LifecycleNode.declare_parameter",
        raises="rclcpp::exceptions::ParameterAlreadyDeclaredException",
        when=Raises.REPEATED,
    ),
    OutcomeRule(
        ".as_bool .as_int .as_double .as_string rclcpp::Parameter.as_bool "
        "rclcpp::Parameter.as_int rclcpp::Parameter.as_double rclcpp::Parameter.as_string",
        raises="rclcpp::ParameterTypeException",
        when=Raises.OTHER_TYPE,
    ),
    OutcomeRule("locale", raises="std::runtime_error"),
    OutcomeRule("typeid", raises="std::bad_typeid"),
    OutcomeRule("file.exceptions", raises="std::ios_base::failure"),
    *_QUIET,
    OutcomeRule(
        "ament_index_cpp::get_package_share_directory ament_index_cpp::get_package_prefix",
        raises="ament_index_cpp::PackageNotFoundError",
    ),
)
