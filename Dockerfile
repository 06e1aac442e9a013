# docker build --tag congruent .
# docker run --rm --volume "$PWD:/work" congruent check robots/ur5e
FROM rust:1.95-bookworm AS build
WORKDIR /source
COPY . .
RUN cargo build --profile dist --locked --package congruent-cli

FROM debian:bookworm-slim
COPY --from=build /source/target/dist/congruent /usr/local/bin/congruent
COPY --from=build /source/LICENSE-APACHE /source/LICENSE-MIT /usr/share/doc/congruent/
WORKDIR /work
ENTRYPOINT ["congruent"]
