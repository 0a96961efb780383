// Names and files from a stranger: what a case names is read as a file or refused; nothing is fetched from elsewhere.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include "hand_rasters.hh"

namespace lgiw::test {
namespace {

/// A port of this machine on which somebody listens.
class Listener {
 public:
  Listener() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), size) == 0 && listen(socket_, 8) == 0 &&
        getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0)
      port_ = ntohs(address.sin_port);
  }
  ~Listener() { close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/dem.tif"; }
  int port() const { return port_; }
  bool called() const {
    pollfd waiting{socket_, POLLIN, 0};
    return poll(&waiting, 1, 0) > 0;
  }
  int connect_to() const {
    const int client = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(uint16_t(port_));
    const int status = connect(client, reinterpret_cast<sockaddr*>(&address), sizeof address);
    close(client);
    return status;
  }

 private:
  int socket_, port_ = 0;
};

Case case_with(const std::string& file) {
  Case c;
  c.name = "hostile";
  c.dp = 10;
  c.terrain.crs = "EPSG:32611";
  c.terrain.sources = {TerrainSource{file, 0, 0, ""}};
  c.water.present = true;
  c.water.level = 10;
  c.water.seed = Point2{45, 105};
  return c;
}

std::string refusal(const Case& c) {
  try {
    Provenance provenance;
    build_terrain(c, provenance);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Hostile, TheListenerHears) {
  const Listener listener;
  ASSERT_NE(listener.port(), 0);
  EXPECT_FALSE(listener.called());
  ASSERT_EQ(listener.connect_to(), 0);
  EXPECT_TRUE(listener.called());
}

TEST(Hostile, NoNameOfARasterOpensAConnection) {
  const Listener listener;
  ASSERT_NE(listener.port(), 0);
  const Scratch scratch;
  const std::string url = listener.url();
  const std::string vrt =
      "<VRTDataset rasterXSize=\"20\" rasterYSize=\"20\"><GeoTransform>0,10,0,200,0,-10</GeoTransform>"
      "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"0\">/vsicurl/" +
      url + "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
  const std::string wms = "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>" + url +
                          "</ServerUrl></Service><DataWindow><SizeX>20</SizeX><SizeY>20</SizeY></DataWindow>"
                          "<BandsCount>1</BandsCount></GDAL_WMS>";
  std::ofstream(scratch("dem.vrt")) << vrt;
  std::ofstream(scratch("dem.xml")) << wms;
  for (const std::string& name :
       {"/vsicurl/" + url, "/vsicurl_streaming/" + url, "/vsizip//vsicurl/" + url + "/x.tif", "/vsitar/vsicurl/" + url,
        "/vsisubfile/0_100,/vsicurl/" + url, url, vrt, wms, scratch("dem.vrt"), scratch("dem.xml"), "WMS:" + url,
        "WCS:" + url, "WMTS:" + url, "PLMOSAIC:" + url, "OGCAPI:" + url,
        "PG:host=127.0.0.1 port=" + std::to_string(listener.port())}) {
    EXPECT_NE(refusal(case_with(name)), "accepted") << name;
    EXPECT_FALSE(listener.called()) << name;
  }
}

TEST(Hostile, NoNameOfAnOutlineOpensAConnectionOrStartsAProgram) {
  const Listener listener;
  const Scratch scratch;
  write_asc(scratch("dem.asc"), 0, 0, 10, rows_of(20, 20, 0, 0, 10, [](double x, double) { return 0.1 * x; }));
  std::ofstream(scratch("schema.gml"))
      << "<?xml version=\"1.0\"?><wfs:FeatureCollection xmlns:wfs=\"http://www.opengis.net/wfs\" "
         "xmlns:gml=\"http://www.opengis.net/gml\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
         "xsi:schemaLocation=\"http://www.opengis.net/wfs " +
             listener.url() + "\"><gml:featureMember/></wfs:FeatureCollection>";
  for (const std::string& name :
       {"/vsicurl/" + listener.url(), listener.url(), "WFS:" + listener.url(), "OAPIF:" + listener.url(),
        "ES:" + listener.url(), "MYSQL:x,host=127.0.0.1,port=" + std::to_string(listener.port()),
        "GPSBABEL:nmea:features=waypoints:" + scratch("dem.asc"), scratch("schema.gml")}) {
    Case c = case_with(scratch("dem.asc"));
    c.slide.present = true;
    c.slide.polygon_file = name;
    c.slide.surface.depth = 3;
    EXPECT_NE(refusal(c).find("slide.polygon_file"), std::string::npos) << name << ": " << refusal(c);
    EXPECT_FALSE(listener.called()) << name;
  }
}

}  // namespace
}  // namespace lgiw::test
