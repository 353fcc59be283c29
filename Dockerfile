# docker build -t uplift . && docker run --rm -v "$PWD:/study" uplift run study.toml
FROM rust:1.90-bookworm AS build
RUN apt-get update && apt-get install --yes --no-install-recommends python3-venv && rm -rf /var/lib/apt/lists/*
WORKDIR /uplift
COPY . .
RUN make install PREFIX=/opt/uplift

FROM debian:bookworm-slim
RUN apt-get update && apt-get install --yes --no-install-recommends fonts-dejavu-core && rm -rf /var/lib/apt/lists/*
COPY --from=build /opt/uplift /usr/local
WORKDIR /study
ENTRYPOINT ["uplift"]
