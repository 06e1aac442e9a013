//! What people and other programs read: text, JSON, JUnit, annotations, pages, schemas, terminals.

mod answers;
mod batch;
mod browser;
mod ci;
mod escapes;
mod pages;
mod schemas;
mod snapshots;
mod terminal;
