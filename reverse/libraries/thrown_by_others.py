"""What functions throw of the libraries that nodes use, for wrong texts, missing files or frames.

Each is what the documentation of the library says; what no table has is trusted to return.
"""

from __future__ import annotations

from rebsync.reverse.libraries.outcome_rules import OutcomeRule, Raises

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
        "ament_index_cpp::get_package_share_directory ament_index_cpp::get_package_prefix",
        raises="ament_index_cpp::PackageNotFoundError",
    ),
)
