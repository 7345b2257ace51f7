#include "RigFiles.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <set>

#include "ByteScanner.hpp"
#include "ByteWriter.hpp"
#include "ColmapPose.hpp"
#include "FileContents.hpp"
#include "FreeId.hpp"
#include "ModelLinks.hpp"
#include "NumberWriter.hpp"
#include "TextScanner.hpp"

namespace hybridgv {
namespace sfm {
namespace {

constexpr std::int32_t kCamera = 0, kImu = 1;
constexpr std::size_t kRigBytes = std::size_t{2} * 4, kFrameBytes = 2 * 4 + 7 * 8 + 4, kFrameDataBytes = 4 + 4 + 8;
constexpr std::size_t kRigSensorBytes = 4 + 4 + 1;

// ------------------------------------------------------------------------------------------------------------ text

std::int32_t readSensorType(TextScanner& in) {
  const std::string_view word = in.word("the type of a sensor");
  if (word == "CAMERA") return kCamera;
  if (word == "IMU") return kImu;
  return in.toInteger<std::int32_t>("the type of a sensor", word);
}

SensorId readSensor(TextScanner& in) {
  const std::int32_t type = readSensorType(in);
  return {type, in.integer<std::uint32_t>("the id of a sensor")};
}

// RIG_ID, NUM_SENSORS, REF_SENSOR_TYPE, REF_SENSOR_ID, and each other sensor as SENSOR_TYPE, SENSOR_ID, HAS_POSE, [QW .. TZ]
std::vector<SensorRig> readRigs(TextScanner& in) {
  std::vector<SensorRig> rigs;
  while (in.toNextRecord()) {
    SensorRig& rig = rigs.emplace_back();
    rig.id = in.integer<std::uint32_t>("the rig's id");
    const std::size_t sensors = in.count("the number of sensors of a rig", 2);
    for (std::size_t i = 0; i < sensors; ++i) {
      RigSensor& sensor = rig.sensors.emplace_back();
      sensor.sensor = readSensor(in);
      const bool hasPose = i > 0 && in.integer<int>("whether a sensor has a pose") != 0;
      for (int k = 0; hasPose && k < 7; ++k) sensor.sensorFromRig.push_back(in.number("the pose of a sensor"));
    }
    in.endLine();
  }
  return rigs;
}

// FRAME_ID, RIG_ID, QW .. TZ, NUM_DATA_IDS, and each of these as SENSOR_TYPE, SENSOR_ID, DATA_ID
std::vector<Frame> readFrames(TextScanner& in) {
  std::vector<Frame> frames;
  while (in.toNextRecord()) {
    Frame& frame = frames.emplace_back();
    frame.id = in.integer<std::uint32_t>("the frame's id");
    frame.rigId = in.integer<std::uint32_t>("the frame's rig");
    for (double& value : frame.rigFromWorld) value = in.number("the frame's pose");
    const std::size_t count = in.count("the number of data of a frame", 2);
    for (std::size_t i = 0; i < count; ++i) {
      const SensorId sensor = readSensor(in);
      frame.data.push_back({sensor, in.integer<std::uint64_t>("the id of a datum")});
    }
    in.endLine();
  }
  return frames;
}

// ------------------------------------------------------------------------------------------------------------ binary

SensorId readSensor(ByteScanner& in) {
  const auto type = static_cast<std::int32_t>(in.u32("the type of a sensor"));
  return {type, in.u32("the id of a sensor")};
}

std::vector<SensorRig> readRigs(ByteScanner& in) {
  std::vector<SensorRig> rigs;
  const std::size_t count = in.count("the number of rigs", kRigBytes);
  for (std::size_t i = 0; i < count; ++i) {
    SensorRig& rig = rigs.emplace_back();
    rig.id = in.u32("the rig's id");
    const std::size_t sensors = in.u32("the number of sensors of a rig");
    in.expectRoom("the number of sensors of a rig", sensors, kRigSensorBytes - 1);
    for (std::size_t k = 0; k < sensors; ++k) {
      RigSensor& sensor = rig.sensors.emplace_back();
      sensor.sensor = readSensor(in);
      const bool hasPose = k > 0 && in.byte("whether a sensor has a pose") != 0;
      for (int j = 0; hasPose && j < 7; ++j) sensor.sensorFromRig.push_back(in.number("the pose of a sensor"));
    }
  }
  in.expectEnd();
  return rigs;
}

std::vector<Frame> readFrames(ByteScanner& in) {
  std::vector<Frame> frames;
  const std::size_t count = in.count("the number of frames", kFrameBytes);
  for (std::size_t i = 0; i < count; ++i) {
    Frame& frame = frames.emplace_back();
    frame.id = in.u32("the frame's id");
    frame.rigId = in.u32("the frame's rig");
    for (double& value : frame.rigFromWorld) value = in.number("the frame's pose");
    const std::size_t data = in.u32("the number of data of a frame");
    in.expectRoom("the number of data of a frame", data, kFrameDataBytes);
    for (std::size_t k = 0; k < data; ++k) {
      const SensorId sensor = readSensor(in);
      frame.data.push_back({sensor, in.u64("the id of a datum")});
    }
  }
  in.expectEnd();
  return frames;
}

// ------------------------------------------------------------------------------------------------------------ what belongs together

bool isCamera(const SensorId& sensor) { return sensor.type == kCamera; }

// Keeps what refers to things that are there.
class Pruning {
 public:
  Pruning(const std::string& rigsFile, const std::string& framesFile, Mending& mending, SparseModel& model)
      : rigsFile_(rigsFile), framesFile_(framesFile), mending_(mending), model_(model) {
    for (const Camera& camera : model.cameras) cameras_.insert(camera.id);
    for (std::size_t i = 0; i < model.images.size(); ++i) images_.add(model.images[i].id, i);
  }

  void prune() {
    removeIf(model_.rigs, [&](const SensorRig& rig) { return isRigInvalid(rig); });
    removeIf(model_.frames, [&](Frame& frame) { return isFrameInvalid(frame); });
    const bool isComplete = std::all_of(model_.images.begin(), model_.images.end(),
                                        [&](const Image& image) { return !image.registered || framed_.count(image.id) != 0; });
    if (isComplete) return;
    note(Mend::RigOrFrameInvalid, framesFile_, "an image is in no frame: rigs and frames left out");
    model_.rigs.clear();
    model_.frames.clear();
  }

 private:
  template <class Things, class IsBad>
  static void removeIf(Things& things, const IsBad& isBad) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < things.size(); ++i) {
      if (isBad(things[i])) continue;
      if (kept != i) things[kept] = std::move(things[i]);
      ++kept;
    }
    things.resize(kept);
  }

  void note(Mend mend, const std::string& file, const std::string& reason) {
    mending_.note(mend, [&] { return FileError::inFile(file, reason); });
  }

  bool isRigInvalid(const SensorRig& rig) {
    const std::string name = "rig " + std::to_string(rig.id);
    for (const RigSensor& sensor : rig.sensors)
      if (isCamera(sensor.sensor) && cameras_.count(sensor.sensor.id) == 0) {
        note(Mend::RigOrFrameInvalid, rigsFile_, name + ": there is no camera " + std::to_string(sensor.sensor.id));
        return true;
      }
    if (rigs_.insert(rig.id).second) return false;
    note(Mend::RigOrFrameInvalid, rigsFile_, name + " occurs twice");
    return true;
  }

  bool isFrameInvalid(Frame& frame) {
    const std::string name = "frame " + std::to_string(frame.id);
    if (rigs_.count(frame.rigId) == 0) {
      note(Mend::RigOrFrameInvalid, framesFile_, name + ": there is no rig " + std::to_string(frame.rigId));
      return true;
    }
    if (!frames_.insert(frame.id).second) {
      note(Mend::RigOrFrameInvalid, framesFile_, name + " occurs twice");
      return true;
    }
    removeIf(frame.data, [&](const FrameData& datum) { return isDatumInvalid(name, datum); });
    if (frame.data.empty()) return true;
    compareWithImages(name, frame);
    return false;
  }

  bool isDatumInvalid(const std::string& frame, const FrameData& datum) {
    if (!isCamera(datum.sensor)) return false;
    const std::size_t image = images_.find(datum.id);
    if (image == IdIndex::kNone)
      note(Mend::FrameOfMissingImage, framesFile_, frame + ": " + images_.unknown(datum.id));
    else if (!framed_.insert(model_.images[image].id).second)
      note(Mend::RigOrFrameInvalid, framesFile_, frame + ": image " + std::to_string(datum.id) + " is in two frames");
    else
      return false;
    return true;
  }

  // cam_from_world = sensor_from_rig * rig_from_world
  void compareWithImages(const std::string& name, const Frame& frame) {
    constexpr double kTolerance = 1e-6;
    Image rig;
    const auto& p = frame.rigFromWorld;
    if (!setPoseFromQuaternion(p.data(), {p[4], p[5], p[6]}, rig).empty()) return;
    for (const FrameData& datum : frame.data) {
      const std::size_t index = isCamera(datum.sensor) ? images_.find(datum.id) : IdIndex::kNone;
      const RigSensor* sensor = findSensor(frame.rigId, datum.sensor);
      if (index >= model_.images.size() || sensor == nullptr || !model_.images[index].registered) continue;
      Image mounted;
      mounted.registered = isMountKnown(frame.rigId, *sensor);
      if (!mounted.registered) continue;
      if (!sensor->sensorFromRig.empty()) {
        const std::vector<double>& s = sensor->sensorFromRig;
        if (!setPoseFromQuaternion(s.data(), {s[4], s[5], s[6]}, mounted).empty()) continue;
      }
      const Image& image = model_.images[index];
      const Eigen::Vector3d position = rig.position + rig.rotation * mounted.position;
      const bool isSame = (rig.rotation * mounted.rotation - image.rotation).norm() < kTolerance &&
                          (position - image.position).norm() <= kTolerance * (1 + image.position.norm());
      if (!isSame)
        note(Mend::FrameContradictsImage, framesFile_, name + " has another pose than image " + std::to_string(datum.id));
    }
  }

  const RigSensor* findSensor(std::uint32_t rigId, const SensorId& id) const {
    for (const SensorRig& rig : model_.rigs)
      if (rig.id == rigId)
        for (const RigSensor& sensor : rig.sensors)
          if (sensor.sensor.type == id.type && sensor.sensor.id == id.id) return &sensor;
    return nullptr;
  }

  bool isMountKnown(std::uint32_t rigId, const RigSensor& sensor) const {
    if (!sensor.sensorFromRig.empty()) return true;
    for (const SensorRig& rig : model_.rigs)
      if (rig.id == rigId) return &sensor == rig.sensors.data();
    return false;
  }

  const std::string &rigsFile_, &framesFile_;
  Mending& mending_;
  SparseModel& model_;
  std::set<std::uint32_t> cameras_, rigs_, frames_, framed_;
  IdIndex images_{"image"};
};

template <class Read>
void readRigFiles(const std::string& folder, const std::string& extension, Mending& mending, SparseModel& model,
                  const Read& read) {
  const std::string rigsFile = joinPath(folder, "rigs" + extension), framesFile = joinPath(folder, "frames" + extension);
  if (!isFile(rigsFile) || !isFile(framesFile)) return;
  try {
    read(rigsFile, framesFile);
  } catch (const FileError& error) {  // nothing in them is needed to localize
    mending.note(Mend::RigOrFrameInvalid, [&] { return error; });
    model.rigs.clear();
    model.frames.clear();
    return;
  }
  Pruning(rigsFile, framesFile, mending, model).prune();
}

// ------------------------------------------------------------------------------------------------------------ what is written

// The rigs and frames of the images that are written: COLMAP wants every image in a frame.
class FramesToWrite {
 public:
  std::vector<SensorRig> rigs;
  std::vector<Frame> frames;

  explicit FramesToWrite(const WrittenParts& parts) : model_(parts.model()) {
    std::set<std::uint32_t> cameras;
    for (const Camera& camera : parts.cameras()) cameras.insert(camera.id);
    for (const SensorRig& rig : model_.rigs) addIfComplete(rig, cameras);
    for (const Image* image : parts.images()) written_.insert(image->id);
    for (const Frame& frame : model_.frames) addPruned(frame);
    for (const Image* image : parts.images())
      if (framed_.count(image->id) == 0) addOwnFrame(*image);
  }

 private:
  // COLMAP wants all cameras of a rig.
  void addIfComplete(const SensorRig& rig, const std::set<std::uint32_t>& cameras) {
    const auto isMissing = [&](const RigSensor& s) { return isCamera(s.sensor) && cameras.count(s.sensor.id) == 0; };
    if (std::none_of(rig.sensors.begin(), rig.sensors.end(), isMissing)) rigs.push_back(rig);
  }

  void addPruned(Frame frame) {
    const auto isRig = [&](const SensorRig& rig) { return rig.id == frame.rigId; };
    if (std::none_of(rigs.begin(), rigs.end(), isRig)) return;
    const auto isMissing = [&](const FrameData& datum) { return isCamera(datum.sensor) && written_.count(datum.id) == 0; };
    frame.data.erase(std::remove_if(frame.data.begin(), frame.data.end(), isMissing), frame.data.end());
    for (const FrameData& datum : frame.data)
      if (isCamera(datum.sensor)) framed_.insert(datum.id);
    if (!frame.data.empty()) frames.push_back(std::move(frame));
  }

  // A frame of the rig that has the image's camera, or of a new one that has that camera alone.
  void addOwnFrame(const Image& image) {
    const std::uint32_t camera = model_.cameras[image.camera].id;
    Frame frame;
    frame.id = freeId(frames.begin(), frames.end(), image.id);
    frame.rigFromWorld = colmapPose(image);
    frame.data = {{{kCamera, camera}, image.id}};
    const SensorRig* rig = nullptr;
    for (const SensorRig& candidate : rigs)
      for (const RigSensor& sensor : candidate.sensors) {
        if (!isCamera(sensor.sensor) || sensor.sensor.id != camera) continue;
        rig = &candidate;
        if (!sensor.sensorFromRig.empty()) frame.rigFromWorld = poseOfRig(image, sensor.sensorFromRig);
      }
    if (rig == nullptr) {
      rigs.push_back({freeId(rigs.begin(), rigs.end(), camera), {{{kCamera, camera}, {}}}});
      rig = &rigs.back();
    }
    frame.rigId = rig->id;
    frames.push_back(std::move(frame));
  }

  const SparseModel& model_;
  std::set<std::uint64_t> written_, framed_;
};

const char* sensorWord(std::int32_t type) { return type == kCamera ? "CAMERA" : "IMU"; }

void appendSensor(std::string& text, const SensorId& sensor) {
  text += std::string(" ") + sensorWord(sensor.type);
  appendNumber(text, sensor.id);
}

void putSensor(std::string& bytes, const SensorId& sensor) {
  putInteger(bytes, static_cast<std::uint32_t>(sensor.type), 4);
  putInteger(bytes, sensor.id, 4);
}

}  // namespace

void readRigsText(const std::string& folder, Mending& mending, SparseModel& model) {
  readRigFiles(folder, ".txt", mending, model, [&](const std::string& rigsFile, const std::string& framesFile) {
    TextScanner rigs(rigsFile, TextScanner::Layout::Lines, mending), frames(framesFile, TextScanner::Layout::Lines, mending);
    model.rigs = readRigs(rigs);
    model.frames = readFrames(frames);
  });
}

void readRigsBinary(const std::string& folder, Mending& mending, SparseModel& model) {
  readRigFiles(folder, ".bin", mending, model, [&](const std::string& rigsFile, const std::string& framesFile) {
    ByteScanner rigs(rigsFile, mending), frames(framesFile, mending);
    model.rigs = readRigs(rigs);
    model.frames = readFrames(frames);
  });
}

void writeRigsText(const WrittenParts& parts, FolderReplacement& files) {
  constexpr const char *rigsFile = "rigs.txt", *framesFile = "frames.txt";
  if (parts.model().rigs.empty()) {
    files.remove(rigsFile);
    files.remove(framesFile);
    return;
  }
  std::string text =
      "# RIG_ID NUM_SENSORS REF_SENSOR_TYPE REF_SENSOR_ID SENSORS[] as (SENSOR_TYPE SENSOR_ID HAS_POSE [QW QX QY QZ TX TY TZ])\n";
  const FramesToWrite written(parts);
  for (const SensorRig& rig : written.rigs) {
    appendNumber(text, rig.id);
    appendNumber(text, rig.sensors.size());
    for (const RigSensor& sensor : rig.sensors) {
      appendSensor(text, sensor.sensor);
      if (&sensor == rig.sensors.data()) continue;
      appendNumber(text, sensor.sensorFromRig.empty() ? 0 : 1);
      appendNumbers(text, sensor.sensorFromRig);
    }
    text += '\n';
  }
  files.write(rigsFile, text);
  text = "# FRAME_ID RIG_ID QW QX QY QZ TX TY TZ NUM_DATA_IDS DATA_IDS[] as (SENSOR_TYPE SENSOR_ID DATA_ID)\n";
  for (const Frame& frame : written.frames) {
    appendNumber(text, frame.id);
    appendNumber(text, frame.rigId);
    appendNumbers(text, frame.rigFromWorld);
    appendNumber(text, frame.data.size());
    for (const FrameData& datum : frame.data) {
      appendSensor(text, datum.sensor);
      appendNumber(text, datum.id);
    }
    text += '\n';
  }
  files.write(framesFile, text);
}

void writeRigsBinary(const WrittenParts& parts, FolderReplacement& files) {
  constexpr const char *rigsFile = "rigs.bin", *framesFile = "frames.bin";
  if (parts.model().rigs.empty()) {
    files.remove(rigsFile);
    files.remove(framesFile);
    return;
  }
  const FramesToWrite written(parts);
  std::string bytes;
  putInteger(bytes, written.rigs.size(), 8);
  for (const SensorRig& rig : written.rigs) {
    putInteger(bytes, rig.id, 4);
    putInteger(bytes, rig.sensors.size(), 4);
    for (const RigSensor& sensor : rig.sensors) {
      putSensor(bytes, sensor.sensor);
      if (&sensor == rig.sensors.data()) continue;
      putInteger(bytes, sensor.sensorFromRig.empty() ? 0 : 1, 1);
      for (const double value : sensor.sensorFromRig) putNumber(bytes, value);
    }
  }
  files.write(rigsFile, bytes);
  bytes.clear();
  putInteger(bytes, written.frames.size(), 8);
  for (const Frame& frame : written.frames) {
    putInteger(bytes, frame.id, 4);
    putInteger(bytes, frame.rigId, 4);
    for (const double value : frame.rigFromWorld) putNumber(bytes, value);
    putInteger(bytes, frame.data.size(), 4);
    for (const FrameData& datum : frame.data) {
      putSensor(bytes, datum.sensor);
      putInteger(bytes, datum.id, 8);
    }
  }
  files.write(framesFile, bytes);
}

}  // namespace sfm
}  // namespace hybridgv
