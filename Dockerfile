# An image with the programs: docker build -t isocnc . && docker run --rm -v "$PWD:/work" isocnc isolint
FROM debian:12 AS build
WORKDIR /isocnc
COPY scripts/setup scripts/setup
RUN scripts/setup --minimal
COPY . .
RUN cmake --preset release -D ISOCNC_BUILD_TESTS=OFF -D ISOCNC_BUILD_BENCHMARKS=OFF
RUN cmake --build --preset release
RUN cpack --config build/release/CPackConfig.cmake -G DEB -B build/packages

FROM debian:12-slim
COPY --from=build /isocnc/build/packages/*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/*.deb git curl ca-certificates && rm -rf /tmp/*.deb /var/lib/apt/lists/*
COPY --from=build /isocnc/scripts/compare-in-pipeline /usr/local/bin/
WORKDIR /work
CMD ["isolint"]
