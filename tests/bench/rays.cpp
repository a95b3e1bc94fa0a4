#include "rays.h"

#include <fstream>

#include "binaryReader.h"

namespace {

constexpr char kMagic[] = "ccrays01";

template <class T>
void WriteArray(std::ofstream* file, const T* values, size_t count) {
    const uint32_t length = static_cast<uint32_t>(count);
    file->write(reinterpret_cast<const char*>(&length), sizeof(length));
    file->write(reinterpret_cast<const char*>(values),
                static_cast<std::streamsize>(count * sizeof(T)));
}

template <class T>
void WriteValue(std::ofstream* file, T value) {
    file->write(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

void RaySet::AddPacket(const std::vector<Ray>& packet) {
    if (packet.empty()) {
        return;
    }
    packetSizes.push_back(static_cast<uint8_t>(packet.size()));
    rays.insert(rays.end(), packet.begin(), packet.end());
}

void WriteRays(const std::string& path, const std::vector<RaySet>& sets) {
    std::ofstream file(path, std::ios::binary);
    file.write(kMagic, 8);
    WriteValue(&file, static_cast<uint32_t>(sets.size()));
    for (const RaySet& set : sets) {
        WriteArray(&file, set.name.data(), set.name.size());
        WriteValue(&file, static_cast<int32_t>(set.anyHit));
        WriteArray(&file, set.packetSizes.data(), set.packetSizes.size());
        WriteArray(&file, set.rays.data(), set.rays.size());
    }
    file.close();
    if (!file) {
        throw std::runtime_error(path + ": cannot be written");
    }
}

std::vector<RaySet> ReadRays(const std::string& path) {
    BinaryReader reader(path, kMagic);
    std::vector<RaySet> sets(reader.Value<uint32_t>());
    for (RaySet& set : sets) {
        set.name = reader.String();
        set.anyHit = reader.Int() != 0;
        set.packetSizes = reader.Array<uint8_t>();
        set.rays = reader.Array<Ray>();
    }
    return sets;
}

std::vector<RayChunk> SplitIntoChunks(const RaySet& set) {
    std::vector<RayChunk> chunks;
    const Ray* rays = set.rays.data();
    for (size_t first = 0; first < set.packetSizes.size(); first += kPacketsInChunk) {
        RayChunk chunk{rays, 0, &set.packetSizes[first], 0};
        const size_t left = set.packetSizes.size() - first;
        chunk.packetCount = static_cast<int>(std::min<size_t>(left, kPacketsInChunk));
        for (int i = 0; i < chunk.packetCount; ++i) {
            chunk.rayCount += chunk.packetSizes[i];
        }
        rays += chunk.rayCount;
        chunks.push_back(chunk);
    }
    return chunks;
}
